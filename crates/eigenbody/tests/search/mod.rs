//! The worst configuration, against truth and brute force.

mod domain;
mod gradient;
mod worst;
