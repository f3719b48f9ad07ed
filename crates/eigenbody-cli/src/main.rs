//! The eigenbody command.

fn main() {}
