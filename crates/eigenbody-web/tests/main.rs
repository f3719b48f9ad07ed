//! The explorer's server as a browser meets it, and as an attacker does: over real sockets.

// Helpers stop a test as its own lines would.
#![allow(clippy::unwrap_used, clippy::expect_used)]
// H is the book's symbol.
#![allow(non_snake_case)]

mod client;
mod door;
mod files;
mod hostile;
mod load;
mod numbers;
