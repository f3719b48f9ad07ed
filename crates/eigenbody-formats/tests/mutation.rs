//! Accidents that happen to files: flipped bits, pieces cut off, taken out, doubled, elements doubled, values replaced.

use eigenbody::model::Random;

/// Numbers and words that files should not have.
const WORDS: [&str; 12] = [
    "0",
    "-1",
    "1e308",
    "-1e-308",
    "nan",
    "inf",
    "999999999",
    "1e9",
    "",
    "1 2 3 4 5 6 7",
    "joint",
    "..\u{0}",
];

/// A text with one to four accidents.
pub fn mutated(text: &str, random: &mut Random) -> String {
    let mut bytes = text.as_bytes().to_vec();
    let mut below = |n: usize| random.between(0.0, n.max(1) as f64) as usize;
    for _ in 0..=below(4) {
        let (at, length) = (below(bytes.len()), below(80));
        let end = (at + length).min(bytes.len());
        // The next place of a byte.
        let next = |byte: u8, from: usize| bytes.iter().skip(from).position(|&b| b == byte).map(|k| from + k);
        match below(8) {
            0 if !bytes.is_empty() => bytes[at] ^= 1 << below(8),
            1 => bytes.truncate(at),
            2 => {
                bytes.drain(at..end);
            }
            3 => {
                let piece = bytes[at..end].to_vec();
                let to = below(bytes.len());
                bytes.splice(to..to, piece);
            }
            4 => {
                // From one tag to the end of another: often an element, sometimes half of one.
                let open = next(b'<', at);
                let close = open.and_then(|open| next(b'>', open + length));
                if let (Some(open), Some(close)) = (open, close) {
                    let piece = bytes[open..=close].to_vec();
                    bytes.splice(open..open, piece);
                }
            }
            _ => {
                // A value replaced, between two quotes.
                let open = next(b'"', at);
                let close = open.and_then(|open| next(b'"', open + 1));
                if let (Some(open), Some(close)) = (open, close) {
                    let word = WORDS[below(WORDS.len())];
                    bytes.splice(open + 1..close, word.bytes());
                }
            }
        }
    }
    String::from_utf8_lossy(&bytes).into_owned()
}
