super::doors!(Ltl);

/// L has the tree's pattern: nothing fills in between branches.
#[test]
fn factor_keeps_the_pattern_of_the_tree() {
    for case in cases::<f64>(60) {
        let H = mass_matrix(&case.model, &case.q).unwrap();
        let mut factor = Ltl::new(case.model.dofs());
        factor.factor(&H).unwrap();
        for d in 0..case.nv() {
            for e in 0..case.nv() {
                let own = d == e || case.model.dofs().ancestors(d).any(|a| a == e);
                assert!(own || factor.l()[(d, e)] == 0.0, "{}: L[{d}, {e}]", case.name);
            }
        }
    }
}
