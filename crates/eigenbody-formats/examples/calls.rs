//! What calls cost from Rust, for `cargo xtask python-bench`: `calls SMALL BIG COUNT`, one mass matrix of a small robot, and COUNT
//! of a big one on a floating base, into memory that is there and into new memory. One line a figure: name, tab, seconds.

// H is the book's symbol.
#![allow(non_snake_case)]

use eigenbody::batch::Batch;
use eigenbody::dynamics::{CrbaWorkspace, mass_matrix_into};
use eigenbody::{Base, Matrix, Model};
use eigenbody_formats::{LoadOptions, load};
use std::error::Error;
use std::hint::black_box;
use std::time::Instant;

fn main() -> Result<(), Box<dyn Error>> {
    let arguments: Vec<String> = std::env::args().skip(1).collect();
    let [small, big, count] = arguments.as_slice() else { return Err("calls SMALL BIG COUNT".into()) };
    single(&load(small, &LoadOptions::default())?.model)?;
    let floating = LoadOptions { base: Base::Floating, ..LoadOptions::default() };
    batch(&load(big, &floating)?.model, count.parse()?)
}

fn single(model: &Model<f64>) -> Result<(), Box<dyn Error>> {
    let q = model.random(1);
    let (mut room, mut H) = (CrbaWorkspace::new(model), Matrix::zeros(model.nv(), model.nv()));
    let mut best = f64::INFINITY;
    for _ in 0..20 {
        let start = Instant::now();
        for _ in 0..20_000 {
            mass_matrix_into(model, black_box(&q), &mut room, &mut H)?;
        }
        best = best.min(start.elapsed().as_secs_f64() / 20_000.0);
        black_box(&H);
    }
    println!("rust single\t{best:e}");
    Ok(())
}

fn batch(model: &Model<f64>, count: usize) -> Result<(), Box<dyn Error>> {
    let q: Vec<f64> = (1..=count as u64).flat_map(|seed| model.random(seed)).collect();
    let size = count * model.nv() * model.nv();
    let batch = Batch::new(model);
    let (mut H, mut filled, mut fresh) = (vec![1.0; size], f64::INFINITY, f64::INFINITY);
    for _ in 0..3 {
        let start = Instant::now();
        batch.mass_matrices(&q, &mut H)?;
        filled = filled.min(start.elapsed().as_secs_f64());
    }
    drop(H);
    for _ in 0..3 {
        let start = Instant::now();
        let mut H = vec![0.0; size];
        batch.mass_matrices(&q, &mut H)?;
        fresh = fresh.min(start.elapsed().as_secs_f64());
        black_box(&H);
    }
    println!("rust batch\t{filled:e}\nrust batch new\t{fresh:e}");
    Ok(())
}
