//! `--fail-on`: which findings give status 1.

use eigenbody_report::rules;
use eigenbody_study::diagnosis::Severity;
use std::str::FromStr;

/// What counts.
#[derive(Debug, Clone, PartialEq, Eq)]
pub enum FailOn {
    /// Findings of this level or graver.
    Level(Severity),
    /// Findings with these names.
    Codes(Vec<String>),
    /// Nothing: always 0, but for status 2.
    Never,
}

impl FromStr for FailOn {
    type Err = String;

    fn from_str(text: &str) -> Result<Self, String> {
        Ok(match text {
            "note" => Self::Level(Severity::Note),
            "warning" => Self::Level(Severity::Warning),
            "error" => Self::Level(Severity::Error),
            "never" => Self::Never,
            codes => {
                let codes: Vec<String> = codes.split(',').map(|code| code.trim().to_owned()).collect();
                let is_level =
                    |code: &&String| ["note", "warning", "error", "never"].contains(&code.as_str());
                if let Some(level) = codes.iter().find(is_level) {
                    return Err(format!("'{level}' stands alone: levels and names of findings do not mix"));
                }
                let known = |code: &String| rules().any(|rule| rule.code == code);
                if let Some(code) = codes.iter().find(|code| !known(code)) {
                    let names: Vec<&str> = rules().map(|rule| rule.code).collect();
                    return Err(format!(
                        "no level or finding is called '{code}': expected note, warning, error, never, or some of {}",
                        names.join(", ")
                    ));
                }
                Self::Codes(codes)
            }
        })
    }
}
