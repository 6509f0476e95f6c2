//! Lines and tokens of text formats, over bytes and without a copy; errors carry the line.
//!
//! Numbers are read by the standard library's parser, which is correctly rounded: what was written with enough digits
//! comes back bit for bit.
//!
//! Where the run is ended, the lines end too; whoever calls the reader looks at its control then ([`super::read_with`]).
use crate::control::Control;
use crate::error::{Error, Status};

/// A format error at a line.
pub(super) fn bad(line: usize, what: impl std::fmt::Display) -> Error {
    Error::new(Status::Format, format_args!("line {line}: {what}"))
}

/// A token as an error message shows it: short and printable.
pub(super) fn shown(token: &[u8]) -> Shown<'_> {
    Shown(token)
}

/// See [`shown`].
pub(super) struct Shown<'a>(&'a [u8]);

impl std::fmt::Display for Shown<'_> {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        for chunk in self.0[..self.0.len().min(40)].utf8_chunks() {
            write!(f, "{}", chunk.valid().escape_debug())?;
            f.write_str(if chunk.invalid().is_empty() { "" } else { "\u{fffd}" })?;
        }
        f.write_str(if self.0.len() > 40 { "…" } else { "" })
    }
}

/// The lines of a text that hold something besides a comment.
pub(super) struct Lines<'a> {
    rest: &'a [u8],
    number: usize,
    control: &'a Control<'a>,
}

impl<'a> Lines<'a> {
    /// Lines of `text`; `#` starts a comment.
    pub fn new(text: &'a [u8], control: &'a Control<'a>) -> Self {
        Lines { rest: text.strip_prefix(b"\xef\xbb\xbf").unwrap_or(text), number: 0, control }
    }

    /// The number of the line read last, from 1.
    pub fn number(&self) -> usize {
        self.number
    }

    /// The bytes that no line has been taken from yet.
    pub fn remaining(&self) -> &'a [u8] {
        self.rest
    }

    /// The next line, blank or not, without comment handling; `None` at the end.
    pub fn next_raw(&mut self) -> Option<Line<'a>> {
        if self.rest.is_empty() || self.control.step().is_err() {
            return None;
        }
        let (line, rest) = match self.rest.iter().position(|&b| b == b'\n') {
            Some(end) => (&self.rest[..end], &self.rest[end + 1..]),
            None => (self.rest, &[][..]),
        };
        self.rest = rest;
        self.number += 1;
        Some(Line { rest: line, number: self.number })
    }

    /// The next line with content, its comment cut off; `None` at the end.
    pub fn next_line(&mut self) -> Option<Line<'a>> {
        while let Some(mut line) = self.next_raw() {
            if let Some(hash) = line.rest.iter().position(|&b| b == b'#') {
                line.rest = &line.rest[..hash];
            }
            line.skip_blanks();
            if !line.rest.is_empty() {
                return Some(line);
            }
        }
        None
    }

    /// As [`Lines::next_line`], where the end of the file is an error: `what` was expected.
    pub fn expect(&mut self, what: &str) -> Result<Line<'a>, Error> {
        self.next_line()
            .ok_or_else(|| bad(self.number, format_args!("the file ends where {what} was expected")))
    }

    /// Nothing but blanks and comments may follow.
    pub fn expect_end(&mut self, after: &str) -> Result<(), Error> {
        match self.next_line() {
            None => Ok(()),
            Some(mut line) => {
                let token = line.token().unwrap_or_default();
                Err(bad(
                    line.number,
                    format_args!("'{}' after the last {after}: more than the header counts", shown(token)),
                ))
            }
        }
    }
}

/// What is left of a line.
#[derive(Clone, Copy)]
pub(super) struct Line<'a> {
    rest: &'a [u8],
    number: usize,
}

impl<'a> Line<'a> {
    /// The line's number, from 1.
    pub fn number(&self) -> usize {
        self.number
    }

    /// What is left, blanks included.
    pub fn rest(&self) -> &'a [u8] {
        self.rest
    }

    fn skip_blanks(&mut self) {
        let blanks = self.rest.iter().position(|&b| b > b' ').unwrap_or(self.rest.len());
        self.rest = &self.rest[blanks..];
    }

    /// The next token.
    pub fn token(&mut self) -> Option<&'a [u8]> {
        self.skip_blanks();
        let end = self.rest.iter().position(|&b| b <= b' ').unwrap_or(self.rest.len());
        let (token, rest) = self.rest.split_at(end);
        self.rest = rest;
        (!token.is_empty()).then_some(token)
    }

    /// Skips the next token if it is this one.
    pub fn skip(&mut self, token: &[u8]) -> bool {
        let before = self.rest;
        let is_it = self.token() == Some(token);
        if !is_it {
            self.rest = before;
        }
        is_it
    }

    /// The next token, which must exist.
    pub fn expect(&mut self, what: &str) -> Result<&'a [u8], Error> {
        self.token().ok_or_else(|| bad(self.number, format_args!("the line ends where {what} was expected")))
    }

    /// The next token as a double.
    pub fn float(&mut self, what: &str) -> Result<f64, Error> {
        let token = self.expect(what)?;
        float(token)
            .ok_or_else(|| bad(self.number, format_args!("{what} expected, found '{}'", shown(token))))
    }

    /// The next token as an integer.
    pub fn int(&mut self, what: &str) -> Result<i64, Error> {
        let token = self.expect(what)?;
        int(token).ok_or_else(|| bad(self.number, format_args!("{what} expected, found '{}'", shown(token))))
    }

    /// The next token as an integer, if there is one.
    pub fn optional_int(&mut self, what: &str) -> Result<Option<i64>, Error> {
        let mut ahead = *self;
        if ahead.token().is_none() {
            return Ok(None);
        }
        self.int(what).map(Some)
    }

    /// The next token as a marker: an integer that fits 32 bits.
    pub fn optional_marker(&mut self) -> Result<i32, Error> {
        match self.optional_int("a marker")? {
            None => Ok(0),
            Some(value) => i32::try_from(value)
                .map_err(|_| bad(self.number, format_args!("marker {value} does not fit 32 bits"))),
        }
    }

    /// Three doubles.
    pub fn point(&mut self) -> Result<[f64; 3], Error> {
        Ok([self.float("coordinate x")?, self.float("coordinate y")?, self.float("coordinate z")?])
    }

    /// The next token as a count of things that take at least `bytes_each` bytes of the `available` ones.
    pub fn count(&mut self, what: &str, bytes_each: usize, available: usize) -> Result<usize, Error> {
        let value = self.int(what)?;
        let count = usize::try_from(value)
            .map_err(|_| bad(self.number, format_args!("{what} is negative: {value}")))?;
        // The last line may lack its end.
        if count.saturating_mul(bytes_each) > available.saturating_add(1) {
            return Err(bad(
                self.number,
                format_args!("{what} is {count}, more than the rest of the file can hold"),
            ));
        }
        if count >= u32::MAX as usize {
            return Err(Error::new(
                Status::TooLarge,
                format_args!("line {}: {what} is {count}: too large", self.number),
            ));
        }
        Ok(count)
    }
}

/// A token as a double (decimal; `inf` and `nan` are read, for the engine to refuse).
pub(super) fn float(token: &[u8]) -> Option<f64> {
    std::str::from_utf8(token).ok()?.parse().ok()
}

/// A token as an integer.
pub(super) fn int(token: &[u8]) -> Option<i64> {
    let (negative, digits) = match token.split_first()? {
        (b'-', digits) => (true, digits),
        (b'+', digits) => (false, digits),
        _ => (false, token),
    };
    if digits.is_empty() || digits.len() > 18 {
        return None;
    }
    let mut value = 0i64;
    for &digit in digits {
        if !digit.is_ascii_digit() {
            return None;
        }
        value = value * 10 + i64::from(digit - b'0');
    }
    Some(if negative { -value } else { value })
}
