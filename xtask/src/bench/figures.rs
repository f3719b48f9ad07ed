//! Measured numbers by name.

use std::collections::BTreeMap;

/// Every number that was measured, as often as it was.
#[derive(Debug, Default)]
pub struct Figures {
    numbers: BTreeMap<String, Vec<f64>>,
}

impl Figures {
    /// Takes one line a number: name, tab, number.
    pub fn read(&mut self, lines: &str) -> Result<(), String> {
        for line in lines.lines() {
            let number = line.split_once('\t').and_then(|(name, x)| Some((name, x.trim().parse().ok()?)));
            let (name, number) = number.ok_or_else(|| format!("not a measurement: `{line}`"))?;
            self.numbers.entry(name.to_owned()).or_default().push(number);
        }
        Ok(())
    }

    /// The median of a number's measurements; NaN where there is none, which then shows in the table.
    pub fn get(&self, name: &str) -> f64 {
        median(self.all(name).to_vec())
    }

    /// The median of quotients of measurements that were taken in the same turn: what a machine does for longer than a turn falls on both.
    pub fn ratio(&self, over: &str, under: &str) -> f64 {
        median(self.all(over).iter().zip(self.all(under)).map(|(over, under)| over / under).collect())
    }

    fn all(&self, name: &str) -> &[f64] {
        self.numbers.get(name).map_or(&[], Vec::as_slice)
    }

    /// The names that start with `prefix`, without it.
    pub fn names<'a>(&'a self, prefix: &'a str) -> impl Iterator<Item = &'a str> {
        self.numbers.keys().filter_map(move |name| name.strip_prefix(prefix))
    }

    /// All medians, as a JSON object.
    pub fn json(&self) -> String {
        let line = |name: &String| format!("  \"{name}\": {:e}", self.get(name));
        format!("{{\n{}\n}}\n", self.numbers.keys().map(line).collect::<Vec<_>>().join(",\n"))
    }
}

fn median(mut numbers: Vec<f64>) -> f64 {
    numbers.sort_by(f64::total_cmp);
    numbers.get(numbers.len() / 2).copied().unwrap_or(f64::NAN)
}

#[cfg(test)]
mod tests {
    use super::Figures;

    #[test]
    fn medians_by_name() {
        let mut figures = Figures::default();
        figures.read("a b\t1e-3\nc\t2").unwrap();
        figures.read("a b\t3e-3\n").unwrap();
        figures.read("a b\t2e-3\n").unwrap();
        assert_eq!(figures.get("a b"), 2e-3);
        assert!(figures.get("d").is_nan());
        assert_eq!(figures.names("a ").collect::<Vec<_>>(), ["b"]);
        assert_eq!(figures.json(), "{\n  \"a b\": 2e-3,\n  \"c\": 2e0\n}\n");
        figures.read("slow\t2\nfast\t1\nslow\t60\nfast\t20\nslow\t6\nfast\t4").unwrap();
        assert_eq!(figures.ratio("slow", "fast"), 2.0);
        assert!(figures.ratio("slow", "d").is_nan());
        assert_eq!(figures.read("error"), Err("not a measurement: `error`".into()));
    }
}
