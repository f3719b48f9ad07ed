//! Tests, one module a source module.
