use super::values::{ARITHMETIC, POWERS, ROOTS, SINE_COSINE};
use eigenbody::model::Random;
use eigenbody::scalar::{Dd, Real, Scalar};

fn dd((hi, lo): (f64, f64)) -> Dd {
    Dd::from_sum(hi, lo)
}

/// |found − expected| ≤ c·ε·|expected|.
#[track_caller]
fn assert_close(found: Dd, expected: (f64, f64), c: f64, what: &str) {
    let error = (found - dd(expected)).abs().to_f64();
    assert!(
        error <= c * Dd::EPSILON * expected.0.abs(),
        "{what}: {found:?}, expected {expected:?}, off by {error:e}"
    );
}

/// ε = 4u², u = 2⁻⁵³. Joldes, Muller, Popescu: 3u² for a sum, 5u² for a product, 10u² for a quotient; Karp's root 4u².
/// One u² more for the expected value.
#[test]
fn arithmetic_within_its_bounds() {
    for [x, y, sum, product, quotient, root] in ARITHMETIC {
        let what = format!("{x:?} and {y:?}");
        assert_close(dd(x) + dd(y), sum, 1.0, &what);
        assert_close(dd(x) - -dd(y), sum, 1.0, &what);
        assert_close(dd(x) * dd(y), product, 1.5, &what);
        assert_close(dd(x) / dd(y), quotient, 2.75, &what);
        assert_close(dd(x).abs().sqrt(), root, 1.25, &what);
    }
}

/// Integers below 2¹⁰⁶ are exact, and so is all arithmetic on them that stays below.
#[test]
fn integers_are_exact() {
    let exact = |x: Dd| x.hi() as i128 + x.lo() as i128;
    let mut random = Random::new(1);
    for _ in 0..2000 {
        let [a, b] = [0; 2].map(|_| (random.bits() as i64 >> 12) as i128);
        let number = |x: i128| Dd::from_f64(x as f64);
        assert_eq!(exact(number(a) * number(b)), a * b);
        let product = number(a) * number(b);
        assert_eq!(exact(product + number(a)), a * b + a);
        assert_eq!(exact(product - number(b)), a * b - b);
        assert_eq!(exact(product / number(b)), a);
        assert_eq!(exact((number(a) * number(a)).sqrt()), a.abs());
    }
}

/// Repeated squaring: n products of 5u² at most in each of log₂ n squares, doubled by every later one: 2n of them.
#[test]
fn powers_and_roots() {
    for (x, n, power) in POWERS {
        assert_close(dd(x).powi(n), power, 2.5 * f64::from(n), &format!("{x:?}^{n}"));
    }
    // Newton's correction is n times better conditioned than the power in it: two powers' rounding over n.
    for (x, n, root) in ROOTS {
        assert_close(dd(x).root(n), root, 8.0, &format!("root {n} of {x:?}"));
    }
}

/// Absolute error ε/2, at small angles relative; n π/2 is subtracted with 159 bits of π/2: n·2⁻¹⁶⁰ more.
#[test]
fn sine_and_cosine() {
    for [x, sine, cosine] in SINE_COSINE {
        let (s, c) = dd(x).sin_cos();
        let turns = (x.0 / std::f64::consts::FRAC_PI_2).abs();
        for (found, expected) in [(s, sine), (c, cosine)] {
            let error = (found - dd(expected)).abs().to_f64();
            let small = if turns < 0.5 { expected.0.abs() } else { 1.0 };
            let tolerance = 0.5 * Dd::EPSILON * small + turns * (-160f64).exp2();
            assert!(error <= tolerance, "{x:?}: {found:?}, expected {expected:?}, off by {error:e}");
        }
    }
}

/// sin² + cos² = 1 to 10⁻³¹, also where the quadrant changes.
#[test]
fn sine_and_cosine_lie_on_the_circle() {
    let mut random = Random::new(2);
    for k in 0..4000 {
        let x = Dd::from_sum(random.between(-1.0, 1.0) * f64::from(k), random.between(-1.0, 1.0) * 1e-17);
        let (s, c) = x.sin_cos();
        assert!((s * s + c * c - Dd::ONE).abs().to_f64() < 1e-31, "{x:?}");
    }
}

/// sin 2x = 2 sin x cos x ties every quadrant to its neighbours.
#[test]
fn double_angle() {
    let mut random = Random::new(3);
    for _ in 0..2000 {
        let x = Dd::from_sum(random.between(-20.0, 20.0), random.between(-1.0, 1.0) * 1e-16);
        let (s, c) = x.sin_cos();
        let (s2, c2) = (x + x).sin_cos();
        // 2 ε: half a unit in each of four sines and cosines
        assert!((s2 - (s * c + s * c)).abs().to_f64() < 2.0 * Dd::EPSILON, "{x:?}");
        assert!((c2 - (c * c - s * s)).abs().to_f64() < 2.0 * Dd::EPSILON, "{x:?}");
    }
}

#[test]
fn order_looks_at_both_parts() {
    let one = Dd::ONE;
    let more = Dd::from_sum(1.0, 1e-20);
    assert!(one < more);
    assert!(-more < -one);
    assert_eq!((one.min(more), one.max(more)), (one, more));
    assert_eq!(one.select_lt(more, Dd::ZERO, one), Dd::ZERO);
    assert_eq!(more.select_lt(one, Dd::ZERO, one), one);
    assert_eq!(Dd::from_sum(-1.0, 1e-20).abs(), Dd::from_sum(1.0, -1e-20));
    assert!(!Dd::from_f64(f64::NAN).is_finite() && !(Dd::ONE / Dd::ZERO).is_finite());
    assert_eq!(Dd::ZERO.sqrt(), Dd::ZERO);
    assert_eq!(Dd::from_f64(2.0).mul_add(Dd::from_f64(3.0), one), Dd::from_f64(7.0));
}

/// Up to the end of the range, with and without a fused instruction: a product that is a number has both its parts.
#[test]
fn large_products_are_exact() {
    let exact = |x: f64, y: f64, hi: f64, lo: f64| {
        for product in [Dd::from_product(x, y), Dd::from_product(y, x), Dd::from(x) * Dd::from(y)] {
            assert_eq!((product.hi(), product.lo()), (hi, lo), "{x:e} {y:e}");
        }
    };
    for x in [1e301, -1.7e308, f64::MAX, 2f64.powi(996), 2f64.powi(1023)] {
        exact(x, 1.0, x, 0.0);
        exact(x, 2f64.powi(-1000), x * 2f64.powi(-1000), 0.0);
        assert_eq!(Dd::from(x) / Dd::from(x), Dd::ONE);
    }
    // (1 + 2⁻³⁰)² = 1 + 2⁻²⁹ + 2⁻⁶⁰, times 2¹⁰⁰⁰.
    let x = 1.0 + 2f64.powi(-30);
    let large = 2f64.powi(1000);
    exact(x * large, x, (1.0 + 2f64.powi(-29)) * large, 2f64.powi(940));
    exact(
        x * large * 2f64.powi(20),
        x * 2f64.powi(-40),
        (1.0 + 2f64.powi(-29)) * 2f64.powi(980),
        2f64.powi(920),
    );
    assert!(!(Dd::from(1e301) * Dd::from(1e10)).is_finite());
}

#[test]
fn roots_at_the_edges() {
    for n in [1, 2, 7] {
        assert_eq!(Dd::ZERO.root(n), Dd::ZERO);
        assert!(!Dd::from(-1.0).root(n).is_finite());
    }
    for x in [0.0, 1.0, 2.0] {
        assert!(!Dd::from(x).root(0).is_finite());
    }
    assert_eq!(Dd::from(3.0).root(1), Dd::from(3.0));
}

/// The nearest f64, and the nearest f64 to the rest, by another language's integers.
#[test]
fn decimals_are_read_to_the_last_digit() {
    #[rustfmt::skip]
    let decimals = [
        ("0.7", 0.7, 4.4408920985006264e-17),
        ("1e60", 1e60, 5.061286470292598e+43),
        ("1e45", 1e45, 7.024271097546445e+28),
        ("-1.2345678901234567890123456789e200", -1.2345678901234567e+200, -3.920311958505049e+183),
        ("7e-290", 7e-290, 3.70533281469387e-306),
        (".314159265358979323846264338327950288419716939937510582097494459230781640628620899862803E1",
            std::f64::consts::PI, 1.2246467991473532e-16),
        ("123456789012345678901234567890123456789012345678901234567890",
            1.2345678901234567e+59, 8.544914961406212e+42),
        ("+1.e+308", 1e308, -1.0979063629440455e+291),
        ("2.5e-320", 2.5e-320, 0.0),
        ("9007199254740993", 9007199254740992.0, 1.0),
        ("0001e23", 1e23, 8388608.0),
        ("-0.5", -0.5, 0.0),
        ("0e999999999999", 0.0, 0.0),
        ("1e-999999999999", 0.0, 0.0),
    ];
    for (text, hi, lo) in decimals {
        let found: Dd = text.parse().unwrap();
        assert_eq!((found.hi(), found.lo()), (hi, lo), "{text}");
    }
    assert_eq!("-inf".parse::<Dd>().unwrap().hi(), f64::NEG_INFINITY);
    assert!("nan".parse::<Dd>().unwrap().hi().is_nan());
    for bad in ["", "-", "1e", "1.2.3", "0x10"] {
        assert!(bad.parse::<Dd>().is_err(), "{bad}");
    }
}
