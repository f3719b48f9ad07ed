//! A list of steps, run one after the other, timed, and summed up in a table.

use std::time::{Duration, Instant};

use crate::Outcome;

/// One step of a task.
pub struct Step {
    /// What the summary calls it.
    pub name: &'static str,
    /// The step without which this one makes no sense.
    pub needs: Option<&'static str>,
    /// What it does.
    pub run: fn() -> Outcome,
}

#[derive(Clone, Copy, PartialEq, Debug)]
enum Verdict {
    Passed,
    Failed,
    Skipped,
}

struct Row {
    name: &'static str,
    time: Duration,
    verdict: Verdict,
    /// What a failed step says.
    message: String,
}

/// Runs every step, also after a failure, so that one run tells everything. A step whose need failed is skipped.
pub fn run<'a>(steps: impl IntoIterator<Item = &'a Step>) -> Outcome {
    let rows = rows(steps);
    for Row { name, message, .. } in rows.iter().filter(|row| row.verdict == Verdict::Failed) {
        println!("\n== {name} failed: {message}");
    }
    println!("\n{}", table(&rows));
    let names = |verdict| -> Vec<&str> {
        rows.iter().filter(|row| row.verdict == verdict).map(|row| row.name).collect()
    };
    let failed = names(Verdict::Failed);
    if failed.is_empty() { Ok(()) } else { Err(format!("failed: {}", failed.join(", "))) }
}

fn rows<'a>(steps: impl IntoIterator<Item = &'a Step>) -> Vec<Row> {
    let mut rows: Vec<Row> = Vec::new();
    for step in steps {
        println!("\n== {}", step.name);
        let unmet = step
            .needs
            .filter(|need| rows.iter().any(|row| row.name == *need && row.verdict != Verdict::Passed));
        let start = Instant::now();
        let (verdict, message) = match unmet {
            Some(need) => {
                println!("skipped: needs {need}");
                (Verdict::Skipped, String::new())
            }
            None => match (step.run)() {
                Ok(()) => (Verdict::Passed, String::new()),
                Err(message) => {
                    eprintln!("error: {}: {}", step.name, message.lines().next().unwrap_or_default());
                    (Verdict::Failed, message)
                }
            },
        };
        rows.push(Row { name: step.name, time: start.elapsed(), verdict, message });
    }
    rows
}

fn table(rows: &[Row]) -> String {
    let mut text = format!("{:<12} {:>8}  verdict", "step", "seconds");
    for Row { name, time, verdict, .. } in rows {
        let verdict = match verdict {
            Verdict::Passed => "passed",
            Verdict::Failed => "FAILED",
            Verdict::Skipped => "skipped",
        };
        text += &format!("\n{name:<12} {:>8.1}  {verdict}", time.as_secs_f64());
    }
    text
}

#[cfg(test)]
mod tests {
    use super::*;

    const STEPS: [Step; 4] = [
        Step { name: "sound", needs: None, run: || Ok(()) },
        Step { name: "broken", needs: None, run: || Err("as planned".into()) },
        Step { name: "dependent", needs: Some("broken"), run: || Ok(()) },
        Step { name: "independent", needs: Some("sound"), run: || Ok(()) },
    ];

    #[test]
    fn a_failure_skips_only_what_needs_it() {
        let verdicts: Vec<Verdict> = rows(&STEPS).iter().map(|row| row.verdict).collect();
        assert_eq!(verdicts, [Verdict::Passed, Verdict::Failed, Verdict::Skipped, Verdict::Passed]);
    }

    #[test]
    fn the_outcome_names_the_steps_that_failed() {
        assert_eq!(run(&STEPS), Err("failed: broken".into()));
        assert_eq!(run(&STEPS[..1]), Ok(()));
    }

    #[test]
    fn the_table_is_aligned() {
        let row = |name, time, verdict| Row { name, time, verdict, message: String::new() };
        let rows = [
            row("test", Duration::from_millis(61_250), Verdict::Passed),
            row("conformance", Duration::ZERO, Verdict::Skipped),
        ];
        let expected = "\
step          seconds  verdict
test             61.2  passed
conformance       0.0  skipped";
        assert_eq!(table(&rows), expected);
    }
}
