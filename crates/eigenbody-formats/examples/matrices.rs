//! H of many files, for `oracle/collections.py` to compare: one process, a line of JSON a file.
//!
//! Standard input: one request a line, `{"path": .., "base": "fixed"|"floating", "mimic": true|false, "configurations": 10}`.
//! Standard output: `{"dofs": [..], "joints": [..], "q": [[..]], "H": [[..]], "findings": [..], "seconds": ..}`, or
//! `{"error": ".."}`. H by rows; q all coordinates, or the independent ones where joints follow.

// H is the book's symbol.
#![allow(non_snake_case)]

use eigenbody::{Base, Reduction};
use eigenbody_formats::{LoadOptions, Loaded, load};
use serde_json::{Value, json};
use std::io::{BufRead, Write};
use std::time::Instant;

fn main() -> std::io::Result<()> {
    let mut out = std::io::stdout().lock();
    for line in std::io::stdin().lock().lines() {
        let answer = answer(&line?).unwrap_or_else(|error| json!({ "error": error }));
        writeln!(out, "{answer}")?;
        out.flush()?;
    }
    Ok(())
}

fn answer(line: &str) -> Result<Value, String> {
    let request: Value = serde_json::from_str(line).map_err(|error| error.to_string())?;
    let base = if request["base"] == "floating" { Base::Floating } else { Base::Fixed };
    let path = request["path"].as_str().ok_or("no path")?;
    let start = Instant::now();
    let options = LoadOptions { base, ..LoadOptions::default() };
    let loaded = load(path, &options).map_err(|error| error.to_string())?;
    let seconds = start.elapsed().as_secs_f64();
    let reduction = Reduction { mimic: request["mimic"] == true, base: false };
    let mut answer = matrices(&loaded, reduction, request["configurations"].as_u64().unwrap_or(10))?;
    answer["seconds"] = json!(seconds);
    Ok(answer)
}

fn matrices(loaded: &Loaded, reduction: Reduction, configurations: u64) -> Result<Value, String> {
    let model = &loaded.model;
    let (mut rows, mut coordinates) = (Vec::new(), Vec::new());
    for seed in 1..=configurations {
        let q = loaded.configuration(&format!("random({seed})"), reduction.mimic);
        let q = q.map_err(|error| error.to_string())?;
        let H = reduction.mass_matrix(model, &q).map_err(|error| error.to_string())?;
        rows.push(H.as_slice().to_vec());
        coordinates.push(q);
    }
    let dofs: Vec<String> = reduction.dofs(model).into_iter().map(|d| model.dof_name(d)).collect();
    let joints: Vec<Value> = model
        .joints()
        .iter()
        .map(|j| json!([j.name(), j.kind().kind(), j.coordinates().start, j.dofs().start]))
        .collect();
    Ok(json!({
        "dofs": dofs, "joints": joints, "q": coordinates, "H": rows, "findings": loaded.findings(),
    }))
}
