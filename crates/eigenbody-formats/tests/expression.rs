//! Arithmetic and calls.

use eigenbody_formats::expression::{Value, call, number};
use insta::assert_snapshot;
use std::f64::consts::PI;
use std::ops::Add;

fn error(text: &str) -> String {
    number(text).unwrap_err().to_string()
}

#[test]
fn arithmetic_is_rounded_once() {
    let cases = [
        ("2", 2.0),
        (" .5 ", 0.5),
        ("1.", 1.0),
        ("1e3", 1e3),
        ("2.5E-3", 2.5e-3),
        ("1e+2", 100.0),
        ("pi", PI),
        ("π/2", PI / 2.0),
        ("-pi/2", -PI / 2.0),
        ("--2", 2.0),
        ("+-+2", -2.0),
        ("1 - 2 - 3", -4.0),
        ("8/4/2", 1.0),
        // 49·(1/49) is not 1.
        ("49/49", 1.0),
        ("1 + 2*3", 7.0),
        ("(1 + 2)*3", 9.0),
        ("2*-3", -6.0),
        ("-(1 - (2 - 3))", -2.0),
        // A decimal stands for itself: in f64 the sum would be 0.30000000000000004.
        ("0.1 + 0.2", 0.3),
        ("123456789.123456789", 123_456_789.123_456_79),
    ];
    for (text, expected) in cases {
        assert_eq!(number(text), Ok(expected), "{text}");
    }
}

#[test]
fn numbers_keep_every_digit() {
    for x in [0.1 + 0.2, 1.0 / 3.0, 5e-324, f64::MAX, 2.2250738585072014e-308, -PI] {
        assert_eq!(number(&format!("{x:e}")).unwrap().to_bits(), x.to_bits());
        assert_eq!(number(&format!("{x:?}")).unwrap().to_bits(), x.to_bits());
    }
}

#[test]
fn calls_have_named_and_unnamed_arguments() {
    let chain = call(" chain ( 4, m = 2.2 , l=[1, 2/4] ) ").unwrap();
    assert_eq!(chain.name, "chain");
    let keys: Vec<_> = chain.arguments.iter().map(|argument| argument.key).collect();
    assert_eq!(keys, [None, Some("m"), Some("l")]);
    assert_eq!(chain.arguments[1].value, Value::Number("2.2".parse().unwrap()));
    let Value::List(list) = &chain.arguments[2].value else { panic!("no list") };
    assert_eq!(list.iter().map(|number| number.value).collect::<Vec<_>>(), [1.0, 0.5]);
    // m after " chain ( 4, ", the list's second number after "m = 2.2 , l=[1, ".
    assert_eq!((chain.arguments[1].offset, list[1].offset), (12, 28));
    assert_eq!(call("f()").unwrap().arguments, []);
    assert_eq!(call("pi(pi)").unwrap().arguments[0].value, Value::Number(eigenbody::scalar::Dd::PI));
}

#[test]
fn malformed_calls_are_refused() {
    let error = |text| call(text).unwrap_err().to_string();
    assert_snapshot!(error("f"), @"f, column 2: expected '(', found the end");
    assert_snapshot!(error("f(1,)"), @"f(1,), column 5: ')' is not a number; expected a number such as 0.3 or pi/2");
    assert_snapshot!(error("f(1"), @"f(1, column 4: expected ')', found the end");
    assert_snapshot!(error("f(1) 2"), @"f(1) 2, column 6: expected the end, found '2'");
    assert_snapshot!(error("f([1, 2)"), @"f([1, 2), column 8: expected ']', found ')'");
    assert_snapshot!(error("f([[1]])"), @"f([[1]]), column 4: '[' is not a number; expected a number such as 0.3 or pi/2");
    assert_snapshot!(error("f(a=)"), @"f(a=), column 5: ')' is not a number; expected a number such as 0.3 or pi/2");
    assert_snapshot!(error("3(1)"), @"3(1), column 1: expected a name, found '3'");
}

#[test]
fn what_is_no_number_is_named_with_its_column() {
    assert_snapshot!(error("banana"), @"banana, column 1: 'banana' is not a number; expected a number such as 0.3 or pi/2");
    assert_snapshot!(error("1 + banana*2"), @"1 + banana*2, column 5: 'banana' is not a number; expected a number such as 0.3 or pi/2");
    assert_snapshot!(error("nan"), @"nan, column 1: 'nan' is not a number; expected a number such as 0.3 or pi/2");
    assert_snapshot!(error("-inf"), @"-inf, column 2: 'inf' is not a number; expected a number such as 0.3 or pi/2");
    assert_snapshot!(error("1 +"), @"1 +, column 4: the text ends here; expected a number such as 0.3 or pi/2");
    assert_snapshot!(error(""), @"empty text, column 1: the text ends here; expected a number such as 0.3 or pi/2");
    assert_snapshot!(error("."), @"., column 1: '.' is not a number; expected a number such as 0.3 or pi/2");
    assert_snapshot!(error("2pi"), @"2pi, column 2: expected the end, found 'pi'");
    assert_snapshot!(error("1 2"), @"1 2, column 3: expected the end, found '2'");
    assert_snapshot!(error("(1"), @"(1, column 3: expected ')', found the end");
    assert_snapshot!(error("1)"), @"1), column 2: expected the end, found ')'");
    assert_snapshot!(error("2^3"), @"2^3, column 2: expected the end, found '^'");
    assert_snapshot!(error("π + π + x"), @"π + π + x, column 9: 'x' is not a number; expected a number such as 0.3 or pi/2");
    assert_snapshot!(error("0x10"), @"0x10, column 2: expected the end, found 'x10'");
    assert_snapshot!(error("1e"), @"1e, column 2: expected the end, found 'e'");
    assert_snapshot!(error("α + é\n"), @r#"α + é\n, column 1: 'α' is not a number; expected a number such as 0.3 or pi/2"#);
}

#[test]
fn values_past_the_range_are_refused_where_they_arise() {
    assert_snapshot!(error("1 + 1/0"), @"1 + 1/0, column 6: the value is not a finite number");
    assert_snapshot!(error("0/0"), @"0/0, column 2: the value is not a finite number");
    assert_snapshot!(error("1e400"), @"1e400, column 1: the value is not a finite number");
    assert_snapshot!(error("1e308*10"), @"1e308*10, column 6: the value is not a finite number");
    assert_snapshot!(error("1 - -1e308 + 1.7e308"), @"1 - -1e308 + 1.7e308, column 12: the value is not a finite number");
}

#[test]
fn depth_is_bounded_and_length_is_not() {
    assert_eq!(number(&format!("{}1{}", "(".repeat(64), ")".repeat(64))), Ok(1.0));
    assert_eq!(number(&"(1)+".repeat(1000).add("1")), Ok(1001.0));
    assert_snapshot!(error(&"(".repeat(1_000_000)), @"((((((((((((((((((((((((((((((((((((((((((((((((((((((((((((…, column 65: more than 64 nested parentheses");
    assert_eq!(number(&"-".repeat(1_000_000).add("1")), Ok(1.0));
    assert_eq!(number(&"1+".repeat(100_000).add("1")), Ok(100_001.0));
}

#[test]
fn messages_are_one_line_and_short() {
    let text = format!("{}\n\u{1b}[31m", "very long ".repeat(1000));
    let message = error(&text);
    assert!(message.chars().count() < 200 && !message.contains(char::is_control), "{message}");
}
