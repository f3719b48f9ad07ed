use eigenbody_study::{EXPERIMENTS, Lab, Values, select};

#[test]
fn names_are_unique_and_selectable() {
    let all: Vec<&str> = EXPERIMENTS.iter().flat_map(|paper| paper.iter().map(|e| e.id)).collect();
    let mut unique = all.clone();
    unique.sort_unstable();
    unique.dedup();
    assert_eq!(unique.len(), all.len());
    for id in &all {
        assert_eq!(select(&[id]).unwrap()[0].id, *id);
    }
    let none: [&str; 0] = [];
    assert_eq!(select(&none).unwrap().len(), all.len());
}

#[test]
fn a_claim_stands_for_its_experiment() {
    let found: Vec<&str> = select(&["S-eq9", "F-eq1-tau", "S-eq7"]).unwrap().iter().map(|e| e.id).collect();
    assert_eq!(found, ["F-eq1", "S-eq7"]);
}

#[test]
fn an_unknown_name_lists_the_known_ones() {
    let message = select(&["F-fig6", "F-fg7"]).unwrap_err().to_string();
    assert!(
        message.starts_with("no experiment or claim 'F-fg7'; did you mean 'F-fig7'?; known: F-Hprime, "),
        "{message}"
    );
    for id in ["F-fig21", "S-eq8", "S-beyond-robots"] {
        assert!(message.contains(&format!(", {id}")), "{message}");
    }
}

/// Every table is whole: columns of one length, named apart, numbers with units.
#[test]
fn tables_are_whole() {
    let lab = Lab { quick: true, ..Lab::default() };
    for id in ["F-fig1", "F-fig3", "F-fig10", "F-fig13", "F-fig17", "S-fig2", "S-eq7", "S-beyond-robots"] {
        let table = select(&[id]).unwrap()[0].run(&lab).unwrap().table;
        assert!(table.rows() > 0, "{id}");
        for column in table.columns() {
            assert_eq!(column.values.len(), table.rows(), "{id}: {}", column.name);
            let is_text = matches!(column.values, Values::Text(_));
            assert_eq!(column.unit.is_empty(), is_text, "{id}: {}", column.name);
        }
    }
}

/// The same robots, the same numbers: to the bit, however many threads.
#[test]
fn results_do_not_depend_on_the_run() {
    let lab = Lab { quick: true, ..Lab::default() };
    for id in ["F-fig20", "S-fig4", "S-beyond-robots"] {
        let experiment = select(&[id]).unwrap()[0];
        assert_eq!(experiment.run(&lab).unwrap(), experiment.run(&lab).unwrap(), "{id}");
    }
}
