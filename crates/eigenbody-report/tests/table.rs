use eigenbody_report::write_table_csv;
use eigenbody_study::Rows;

/// Commas and quotes in words do not break a row; numbers parse back to the same bits.
#[test]
fn csv_is_exact() {
    let mut table = Rows::new(&[("curve", "")], &[("kappa", "1")]);
    let kappa = 10230462.98289487;
    table.push(["curl(0), \"R\" = 1".into()], [Some(kappa)]);
    table.push(["none".into()], [None]);
    let mut text = Vec::new();
    write_table_csv(&table, &mut text).unwrap();
    let text = String::from_utf8(text).unwrap();
    assert_eq!(text, "curve,kappa [1]\n\"curl(0), \"\"R\"\" = 1\",10230462.98289487\nnone,\n");
    assert_eq!("10230462.98289487".parse(), Ok(kappa));
}
