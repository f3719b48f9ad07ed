//! A list in which everything may use only what stands before it.

/// Names in their order.
pub struct Order<'a>(pub &'a [&'a str]);

impl Order<'_> {
    /// What is wrong with `user` using `used`; nothing if `used` stands before it or is the same.
    pub fn objection(&self, user: &str, used: &str) -> Option<String> {
        let place = |name: &str| self.0.iter().position(|other| *other == name);
        match (place(user), place(used)) {
            (Some(user_at), Some(used_at)) if used_at <= user_at => None,
            (Some(_), Some(_)) => Some(format!("`{user}` uses `{used}`, which comes after it")),
            _ => Some(format!("`{user}` uses `{used}`, which is not on the list")),
        }
    }

    /// What is wrong with another list that should be the same in any order.
    pub fn differences(&self, found: &[String]) -> Vec<String> {
        let missing = self.0.iter().filter(|name| !found.iter().any(|other| other == *name));
        let extra = found.iter().filter(|name| !self.0.contains(&name.as_str()));
        let missing = missing.map(|name| format!("`{name}` is on the list but does not exist"));
        missing.chain(extra.map(|name| format!("`{name}` exists but is not on the list"))).collect()
    }
}

#[cfg(test)]
mod tests {
    use super::Order;

    const ORDER: Order<'_> = Order(&["error", "scalar", "model"]);

    #[test]
    fn only_what_stands_before_may_be_used() {
        assert_eq!(ORDER.objection("model", "error"), None);
        assert_eq!(ORDER.objection("model", "model"), None);
        assert_eq!(
            ORDER.objection("scalar", "model"),
            Some("`scalar` uses `model`, which comes after it".into())
        );
        assert_eq!(
            ORDER.objection("scalar", "Model"),
            Some("`scalar` uses `Model`, which is not on the list".into())
        );
    }

    #[test]
    fn lists_must_hold_the_same_names() {
        let found = ["scalar".to_string(), "error".into(), "joint".into()];
        let expected = ["`model` is on the list but does not exist", "`joint` exists but is not on the list"];
        assert_eq!(ORDER.differences(&found), expected);
        assert!(ORDER.differences(&["model".into(), "scalar".into(), "error".into()]).is_empty());
    }
}
