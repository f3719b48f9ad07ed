//! eigenbody beside its peers, alternating.
//!
//! `peers matrices DIR` writes H of hydra(N, 1, 0, 1) at zag(0) to `DIR/N.f64`, row by row, for LAPACK to read.
//! `peers time` times the spectral engine beside dense eigensolvers.
//! `peers motions DIR` writes the configurations of swinging chains to `DIR/swing-ALPHA-N.f64`, and both ends of the spectrum at the last of
//! them to `DIR/swing-ALPHA-N.ends`; `peers track` times the tracker along them.
//! `peers dump DIR URDF..` writes robots to `DIR` in the forms that every peer builds its own from.
//! `peers race DIR NAME=PROGRAM..` times eigenbody, the Rust peers and the programs on these robots, in turn.
//!
//! Measurements go to stdout, one a line: name, tab, number; times in seconds.

// H is the book's symbol.
#![allow(non_snake_case)]

mod batches;
mod clock;
mod contest;
mod dense;
mod dynibo;
mod eigen;
mod ours;
mod quantity;
mod robot;
mod swing;

use std::error::Error;

type Outcome = Result<(), Box<dyn Error>>;

fn main() -> Outcome {
    let arguments: Vec<String> = std::env::args().skip(1).collect();
    match arguments.iter().map(String::as_str).collect::<Vec<_>>()[..] {
        ["matrices", directory] => dense::matrices(directory),
        ["time"] => dense::time(),
        ["motions", directory] => swing::write(directory),
        ["track"] => swing::time(),
        ["dump", directory, ref paths @ ..] => robot::dump(directory, paths),
        ["race", directory, ref programs @ ..] => contest::race(directory, programs),
        _ => Err("usage: peers matrices DIR | time | motions DIR | track | dump DIR URDF.. | race DIR NAME=PROGRAM..".into()),
    }
}
