//! Lines that all end with one line feed, whatever wrote them: then what is read and what is counted are the same.

use std::io::{self, BufRead, Read};

/// A text with its line ends, `\r\n`, `\r` or none at the very end, made `\n`.
pub(super) struct Lines<R> {
    inner: R,
    last: u8,
}

impl<R: BufRead> Lines<R> {
    pub fn new(inner: R) -> Self {
        Self { inner, last: b'\n' }
    }
}

impl<R: BufRead> Read for Lines<R> {
    fn read(&mut self, out: &mut [u8]) -> io::Result<usize> {
        let mut written = 0;
        while written == 0 && !out.is_empty() {
            let bytes = self.inner.fill_buf()?;
            if bytes.is_empty() {
                if !matches!(self.last, b'\n' | b'\r') {
                    self.last = b'\n';
                    out[0] = b'\n';
                    written = 1;
                }
                break;
            }
            let taken = bytes.len().min(out.len());
            for &byte in &bytes[..taken] {
                if !(byte == b'\n' && self.last == b'\r') {
                    out[written] = if byte == b'\r' { b'\n' } else { byte };
                    written += 1;
                }
                self.last = byte;
            }
            self.inner.consume(taken);
        }
        Ok(written)
    }
}

#[cfg(test)]
mod tests {
    use super::Lines;
    use std::io::{BufReader, Read};

    #[test]
    fn all_lines_end_alike() {
        for text in ["a\r\nb\r\n", "a\nb", "a\rb\r", "a\r\nb", "a\nb\n"] {
            for capacity in 1..4 {
                let mut found = String::new();
                Lines::new(BufReader::with_capacity(capacity, text.as_bytes()))
                    .read_to_string(&mut found)
                    .unwrap();
                assert_eq!(found, "a\nb\n", "{text:?}");
            }
        }
    }
}
