//! The study, against its own copy of what the papers print.
