//! `eigenbody sweep`: what it refuses before it begins, and chunks that something else has damaged.

use crate::run::{Scratch, failure, stdout};

#[test]
fn a_misspelt_configuration_is_refused_at_its_place() {
    let scratch = Scratch::new();
    let text = "[[robots]]\nfamily = \"hydra\"\nn = [3, 4]\nat = [\"zero\",\n  \"zagg(1)\"]\n";
    let spec = scratch.file("s.toml", text);
    let message = failure(&["sweep", &spec, "--dry-run"]);
    assert!(message.contains("s.toml:5:4: zagg(1), column 1: no configuration"), "{message}");
    assert!(message.ends_with("(of hydra(3,1.0,0.0,1.0))"), "{message}");
}

#[test]
fn a_damaged_chunk_is_named_and_computed_again() {
    let scratch = Scratch::new();
    let spec = scratch.file("s.toml", "[[robots]]\nfamily = \"hydra\"\nn = [3, 4, 5]\n");
    let folder = scratch.path("out");
    let out = folder.to_str().unwrap();
    let page = stdout(&["sweep", &spec, "-o", out]);
    assert!(page.ends_with("sweep.parquet: 3 rows\n"), "{page}");
    let chunk = folder.join("chunks/000000.csv");
    let (good, table) =
        (std::fs::read_to_string(&chunk).unwrap(), std::fs::read(folder.join("sweep.parquet")).unwrap());
    let short = good.lines().take(3).map(|line| format!("{line}\n")).collect::<String>();
    for damaged in [&short, "garbage", &good.replace("fixed,zero,3", "fixed,zero,x")] {
        std::fs::write(&chunk, damaged).unwrap();
        let message = failure(&["sweep", &spec, "-o", out, "--merge"]);
        assert!(message.contains("chunks/000000.csv: no chunk of this sweep: "), "{message}");
        stdout(&["sweep", &spec, "-o", out]);
        assert_eq!(std::fs::read_to_string(&chunk).unwrap(), good);
        assert_eq!(std::fs::read(folder.join("sweep.parquet")).unwrap(), table);
    }
}
