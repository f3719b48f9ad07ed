//! SARIF 2.1.0: findings where code hosts show them, at the lines of the file.

use super::baseline::{Comparison, State};
use super::{DiagnosisReport, PlaceReport};
use crate::rules::rules;
use serde_json::{Value, json};
use std::collections::BTreeSet;

impl DiagnosisReport {
    /// The report as SARIF 2.1.0, columns counted in characters.
    ///
    /// A finding without a place of its own stands at the first line of the model's file. What a baseline had and this report
    /// has not is `absent`.
    ///
    /// Errors: those of the serialiser.
    pub fn to_sarif(&self) -> Result<String, serde_json::Error> {
        let against = self.comparison.as_ref();
        let mut results: Vec<Value> = Vec::new();
        for (k, finding) in self.findings.iter().enumerate() {
            let text = format!("{}. {}.", sentence(&finding.message), sentence(&finding.advice));
            let mut result = self.result(finding.id, finding.severity, &text, finding.place.as_ref());
            result["partialFingerprints"] = json!({ "eigenbody/v1": finding.identity });
            result["locations"][0]["logicalLocations"] =
                finding.joints.iter().map(|joint| json!({ "name": joint, "kind": "member" })).collect();
            result["properties"] = json!({ "value": finding.value, "limit": finding.limit, "q": finding.q });
            mark(&mut result, against.and_then(|c| c.findings.get(k)));
            results.push(result);
        }
        for (k, remark) in self.remarks.iter().enumerate() {
            let text = format!("{}.", sentence(&remark.message));
            let mut result = self.result(remark.code, "warning", &text, remark.place.as_ref());
            result["partialFingerprints"] = json!({ "eigenbody/v1": remark.identity });
            mark(&mut result, against.and_then(|c| c.remarks.get(k)));
            results.push(result);
        }
        for fixed in against.iter().flat_map(|comparison: &&Comparison| &comparison.fixed) {
            let text = format!("{}.", sentence(&fixed.message));
            let mut result = self.result(&fixed.id, "none", &text, None);
            result["partialFingerprints"] = json!({ "eigenbody/v1": fixed.identity });
            result["baselineState"] = json!("absent");
            results.push(result);
        }
        // Every rule that speaks, those of this list first.
        let spoken: BTreeSet<String> =
            results.iter().filter_map(|r| r["ruleId"].as_str().map(str::to_owned)).collect();
        let known = rules().filter(|rule| spoken.contains(rule.code));
        let mut listed: Vec<Value> = known
            .map(|rule| json!({ "id": rule.code, "shortDescription": { "text": rule.about } }))
            .collect();
        for code in &spoken {
            if !listed.iter().any(|rule| rule["id"] == code.as_str()) {
                listed.push(json!({ "id": code, "shortDescription": { "text": code } }));
            }
        }
        for result in &mut results {
            let index = listed.iter().position(|rule| rule["id"] == result["ruleId"]);
            result["ruleIndex"] = json!(index);
        }
        let log = json!({
            "$schema": "https://json.schemastore.org/sarif-2.1.0.json",
            "version": "2.1.0",
            "runs": [{
                "tool": { "driver": {
                    "name": "eigenbody",
                    "version": env!("CARGO_PKG_VERSION"),
                    "rules": listed,
                } },
                "invocations": [{ "executionSuccessful": true }],
                "columnKind": "unicodeCodePoints",
                "results": results,
            }],
        });
        serde_json::to_string_pretty(&log)
    }

    fn result(&self, code: &str, level: &str, text: &str, place: Option<&PlaceReport>) -> Value {
        let mut result = json!({ "ruleId": code, "level": level, "message": { "text": text } });
        let location = match (place, &self.file) {
            (Some(place), _) => physical(&place.file, place.line, place.column),
            (None, Some(file)) => physical(file, 1, 1),
            // A built-in robot has no lines.
            (None, None) => json!({}),
        };
        result["locations"] = json!([location]);
        result
    }
}

fn mark(result: &mut Value, state: Option<&State>) {
    if let Some(state) = state {
        result["baselineState"] = json!(match state {
            State::New => "new",
            State::Worse => "updated",
            State::Unchanged => "unchanged",
        });
    }
}

fn physical(file: &str, line: u32, column: u32) -> Value {
    json!({ "physicalLocation": {
        "artifactLocation": { "uri": uri(file) },
        "region": { "startLine": line, "startColumn": column },
    } })
}

/// A path as a URI reference: relative to where the command ran if it lies below, else absolute.
fn uri(path: &str) -> String {
    let here = std::env::current_dir().unwrap_or_default();
    let relative = std::path::Path::new(path).strip_prefix(&here).ok().and_then(|path| path.to_str());
    let path = relative.unwrap_or(path);
    let path = path.strip_prefix("./").unwrap_or(path);
    let mut uri = String::from(if path.starts_with('/') { "file://" } else { "" });
    for byte in path.bytes() {
        match byte {
            b'A'..=b'Z' | b'a'..=b'z' | b'0'..=b'9' | b'-' | b'.' | b'_' | b'~' | b'/' => {
                uri.push(byte as char);
            }
            _ => uri.push_str(&format!("%{byte:02X}")),
        }
    }
    uri
}

/// The first letter large.
fn sentence(text: &str) -> String {
    let mut letters = text.chars();
    match letters.next() {
        Some(first) if first.is_ascii_lowercase() => {
            first.to_ascii_uppercase().to_string() + letters.as_str()
        }
        _ => text.to_owned(),
    }
}

#[cfg(test)]
mod tests {
    use super::uri;

    #[test]
    fn paths_become_uris() {
        assert_eq!(uri("robots/my arm é.urdf"), "robots/my%20arm%20%C3%A9.urdf");
        assert_eq!(uri("/opt/a#b.xml"), "file:///opt/a%23b.xml");
        assert_eq!(uri("./a.xml"), "a.xml");
        let here = std::env::current_dir().unwrap_or_default().join("x/y.sdf");
        assert_eq!(uri(&here.display().to_string()), "x/y.sdf");
    }
}
