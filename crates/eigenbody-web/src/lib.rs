//! The explorer: a page on this machine that shows a robot, its modes and its conditioning while it is moved.
//!
//! A [`Server`] listens on the loopback interface, hands out the page, and answers its questions. What the two say to each other is in
//! `API.md`; what is computed is in `eigenbody-study`. The page's built bundle is part of this crate: no Node is needed.
//!
//! ```
//! use eigenbody_web::{Opening, Server};
//! let server = Server::bind(0, Opening::default())?;
//! assert!(server.url().starts_with("http://127.0.0.1:"));
//! let stop = server.stopper();
//! std::thread::spawn(move || stop.stop());
//! server.run()?;
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```
//!
//! # What this crate does not do
//!
//! It serves nobody but this machine, writes no file, and reads none but the robot file named when it was started.

#![forbid(unsafe_code)]
// H is the book's symbol.
#![allow(non_snake_case)]

mod api;
mod asked;
mod assets;
mod explorer;
mod guard;
mod looks;
mod models;
mod refusal;
mod robot;
mod server;
mod work;

pub use explorer::Opening;
pub use robot::{Base, Options};
pub use server::{Server, Stopper};
