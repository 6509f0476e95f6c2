//! Groups of a file (solids, groups, materials, colours) and the markers that they become.
//!
//! While a file is read, its polygons carry the number of their group, from 1 in the order in which groups appear; 0 is no
//! group. At the end every group gets a marker: the one that its name states (`marker_K NAME`), otherwise the lowest from 1 that no group
//! states and no earlier one has.
use crate::error::{Error, Status};
use crate::fallible;
use crate::plc::Plc;
use rustc_hash::FxHashMap;

struct Group {
    stated: Option<i32>,
    name: String,
}

/// What a single group of all polygons of a file means, if it states no marker.
#[derive(Clone, Copy, PartialEq, Eq)]
pub(super) enum Single {
    /// It has a marker like any group.
    Counts,
    /// It divides nothing: the marker is 0, with the group's name.
    Unmarked,
    /// Nothing, as for a model in one colour.
    Nothing,
}

/// The groups of a file.
#[derive(Default)]
pub(super) struct Groups {
    groups: Vec<Group>,
    numbers: FxHashMap<Vec<u8>, i32>,
}

impl Groups {
    /// Adds a group and returns its number. A name `marker_K NAME` states a marker and a name.
    pub fn add(&mut self, name: &[u8]) -> Result<i32, Error> {
        let (stated, name) = match stated_marker(name) {
            Some((marker, rest)) => (Some(marker), rest),
            None => (None, name),
        };
        let number = i32::try_from(self.groups.len() + 1)
            .map_err(|_| Error::new(Status::TooLarge, "more groups than 32-bit markers can number"))?;
        let name = text(name)?;
        fallible::push(&mut self.groups, Group { stated, name })?;
        Ok(number)
    }

    /// The number of the group for a key; `name` is called if it is new.
    pub fn of_key(
        &mut self,
        key: &[u8],
        name: impl FnOnce() -> Result<Vec<u8>, Error>,
    ) -> Result<i32, Error> {
        if let Some(&number) = self.numbers.get(key) {
            return Ok(number);
        }
        let number = self.add(&name()?)?;
        let kept = fallible::copied(key)?;
        fallible::insert(&mut self.numbers, kept, number)?;
        Ok(number)
    }

    /// The group of a marker, 0 for marker 0.
    pub fn of_marker(&mut self, marker: i32) -> Result<i32, Error> {
        if marker == 0 {
            return Ok(0);
        }
        self.of_key(&marker.to_le_bytes(), || {
            let mut digits = itoa::Buffer::new();
            let digits = digits.format(marker).as_bytes();
            let mut name = fallible::reserved(7 + digits.len())?;
            fallible::append(&mut name, b"marker_")?;
            fallible::append(&mut name, digits)?;
            Ok(name)
        })
    }

    /// The group of a colour of three or four components, each from 0 to 255.
    pub fn of_colour(&mut self, colour: &[f64]) -> Result<i32, Error> {
        let mut key = [0; 32];
        key.chunks_exact_mut(8)
            .zip(colour)
            .for_each(|(to, x)| to.copy_from_slice(&x.to_bits().to_le_bytes()));
        self.of_key(&key[..8 * colour.len().min(4)], || {
            const DIGITS: &[u8; 16] = b"0123456789abcdef";
            let mut name = fallible::reserved(9)?;
            fallible::push(&mut name, b'#')?;
            for x in colour.iter().take(4) {
                let byte = x.round().clamp(0.0, 255.0) as usize;
                fallible::append(&mut name, &[DIGITS[byte >> 4], DIGITS[byte & 15]])?;
            }
            Ok(name)
        })
    }

    /// The marker of each group number; stores the names of the markers in `plc`. `single` applies if everything is in one group.
    pub fn markers(&self, single: Single, plc: &mut Plc) -> Result<Vec<i32>, Error> {
        let mut stated: Vec<i32> = fallible::reserved(self.groups.len())?;
        fallible::extend(&mut stated, self.groups.iter().filter_map(|g| g.stated))?;
        stated.sort_unstable();
        let mut markers = fallible::reserved(self.groups.len() + 1)?;
        fallible::push(&mut markers, 0)?;
        let mut next = 1;
        for group in &self.groups {
            let marker = group.stated.unwrap_or_else(|| {
                if single != Single::Counts {
                    return 0;
                }
                while stated.binary_search(&next).is_ok() {
                    next += 1;
                }
                next += 1;
                next - 1
            });
            fallible::push(&mut markers, marker)?;
            let named = group.stated.is_some() || single != Single::Nothing;
            if named && plc.marker_name(marker).is_none() {
                plc.set_marker_name(marker, &group.name)?;
            }
        }
        Ok(markers)
    }
}

/// `marker_K` and what follows it.
pub(super) fn stated_marker(name: &[u8]) -> Option<(i32, &[u8])> {
    let rest = name.strip_prefix(b"marker_")?;
    let end = rest.iter().position(|&b| b <= b' ').unwrap_or(rest.len());
    let marker = super::text::int(&rest[..end]).and_then(|k| i32::try_from(k).ok())?;
    Some((marker, rest[end..].trim_ascii()))
}

/// Bytes as text; invalid UTF-8 becomes U+FFFD.
fn text(bytes: &[u8]) -> Result<String, Error> {
    let mut text = String::new();
    text.try_reserve_exact(bytes.len())?;
    for chunk in bytes.utf8_chunks() {
        fallible::append_text(&mut text, chunk.valid())?;
        if !chunk.invalid().is_empty() {
            fallible::append_text(&mut text, "\u{fffd}")?;
        }
    }
    Ok(text)
}

/// Takes the names of markers from the comments at the top of a file: lines `# marker K NAME` before its second line of content.
pub(super) fn names_in_comments(bytes: &[u8], plc: &mut Plc) -> Result<(), Error> {
    let mut contents = 0;
    for line in bytes.split(|&b| b == b'\n').map(<[u8]>::trim_ascii).filter(|line| !line.is_empty()) {
        match line.strip_prefix(b"#") {
            Some(comment) => take_name(comment, plc)?,
            None if contents == 1 => break,
            None => contents += 1,
        }
    }
    Ok(())
}

/// Takes the name out of a comment `marker K NAME`, if it is one.
pub(super) fn take_name(comment: &[u8], plc: &mut Plc) -> Result<(), Error> {
    let Some(rest) = comment.trim_ascii().strip_prefix(b"marker ") else { return Ok(()) };
    let rest = rest.trim_ascii();
    let end = rest.iter().position(|&b| b <= b' ').unwrap_or(rest.len());
    let Some(marker) = super::text::int(&rest[..end]).and_then(|k| i32::try_from(k).ok()) else {
        return Ok(());
    };
    let name = text(rest[end..].trim_ascii())?;
    if plc.marker_name(marker).is_none() {
        plc.set_marker_name(marker, &name)?;
    }
    Ok(())
}
