//! Allocation that returns an error instead of aborting the process, as the standard library's own functions do: a library must not do that
//! to its host. Everything that grows with the input grows by these functions, or in room taken by `try_reserve`. `.clippy.toml` lists the
//! functions that abort; only this file may call them, always with room for what they add.
#![allow(clippy::disallowed_methods)]
use std::cmp::Ordering;
use std::collections::hash_map::Entry;
use std::collections::{BinaryHeap, HashMap, HashSet, TryReserveError, VecDeque};
use std::fmt::{self, Write};
use std::hash::{BuildHasher, Hash};

/// A value, unless memory ran out.
pub type Room<T> = Result<T, TryReserveError>;

/// Appends one element.
#[inline]
pub fn push<T>(list: &mut Vec<T>, value: T) -> Room<()> {
    // The comparison is the one that `push` makes, which therefore costs nothing more.
    if list.len() == list.capacity() {
        grow(list)?;
    }
    list.push(value);
    Ok(())
}

#[cold]
#[inline(never)]
fn grow<T>(list: &mut Vec<T>) -> Room<()> {
    list.try_reserve(1)
}

/// Appends one element to a queue.
#[inline]
pub fn push_back<T>(queue: &mut VecDeque<T>, value: T) -> Room<()> {
    queue.try_reserve(1)?;
    queue.push_back(value);
    Ok(())
}

/// Adds one element to a heap.
#[inline]
pub fn push_heap<T: Ord>(heap: &mut BinaryHeap<T>, value: T) -> Room<()> {
    heap.try_reserve(1)?;
    heap.push(value);
    Ok(())
}

/// Inserts one element at an index, at most the length.
pub fn insert_at<T>(list: &mut Vec<T>, at: usize, value: T) -> Room<()> {
    list.try_reserve(1)?;
    list.insert(at, value);
    Ok(())
}

/// Appends all elements, which may be more than the iterator's lower bound.
#[inline]
pub fn extend<T>(list: &mut Vec<T>, values: impl IntoIterator<Item = T>) -> Room<()> {
    let values = values.into_iter();
    let (least, most) = values.size_hint();
    list.try_reserve(least)?;
    if most == Some(least) {
        list.extend(values);
        return Ok(());
    }
    for value in values {
        push(list, value)?;
    }
    Ok(())
}

/// Appends a copy of a slice.
#[inline]
pub fn append<T: Copy>(list: &mut Vec<T>, more: &[T]) -> Room<()> {
    list.try_reserve(more.len())?;
    list.extend_from_slice(more);
    Ok(())
}

/// Appends a text.
#[cfg(feature = "io")]
pub fn append_text(text: &mut String, more: &str) -> Room<()> {
    text.try_reserve(more.len())?;
    text.push_str(more);
    Ok(())
}

/// Makes a list this long: cuts it, or appends copies of `value`.
#[inline]
pub fn resize<T: Copy>(list: &mut Vec<T>, count: usize, value: T) -> Room<()> {
    list.try_reserve(count.saturating_sub(list.len()))?;
    list.resize(count, value);
    Ok(())
}

/// Sets the value of a key; returns the previous one.
#[inline]
pub fn insert<K: Eq + Hash, V, S: BuildHasher>(
    map: &mut HashMap<K, V, S>,
    key: K,
    value: V,
) -> Room<Option<V>> {
    map.try_reserve(1)?;
    Ok(map.insert(key, value))
}

/// Sets the values of several keys.
pub fn insert_all<K: Eq + Hash, V, S: BuildHasher>(
    map: &mut HashMap<K, V, S>,
    pairs: impl IntoIterator<Item = (K, V)>,
) -> Room<()> {
    let pairs = pairs.into_iter();
    map.try_reserve(pairs.size_hint().0)?;
    for (key, value) in pairs {
        insert(map, key, value)?;
    }
    Ok(())
}

/// Adds a key; returns whether it is new.
#[inline]
pub fn add<K: Eq + Hash, S: BuildHasher>(set: &mut HashSet<K, S>, key: K) -> Room<bool> {
    set.try_reserve(1)?;
    Ok(set.insert(key))
}

/// Adds several keys.
pub fn add_all<K: Eq + Hash, S: BuildHasher>(
    set: &mut HashSet<K, S>,
    keys: impl IntoIterator<Item = K>,
) -> Room<()> {
    let keys = keys.into_iter();
    set.try_reserve(keys.size_hint().0)?;
    for key in keys {
        add(set, key)?;
    }
    Ok(())
}

/// The place of a key, with room for it if there is none yet.
#[inline]
pub fn entry<K: Eq + Hash, V, S: BuildHasher>(map: &mut HashMap<K, V, S>, key: K) -> Room<Entry<'_, K, V>> {
    map.try_reserve(1)?;
    Ok(map.entry(key))
}

/// Collects all elements in a list.
pub fn collect<T>(values: impl IntoIterator<Item = T>) -> Room<Vec<T>> {
    let mut list = Vec::new();
    extend(&mut list, values)?;
    Ok(list)
}

/// An empty list with room for `count` elements.
pub fn reserved<T>(count: usize) -> Room<Vec<T>> {
    let mut list = Vec::new();
    list.try_reserve_exact(count)?;
    Ok(list)
}

/// A list of `count` equal elements.
pub fn filled<T: Copy>(value: T, count: usize) -> Room<Vec<T>> {
    let mut list = Vec::new();
    list.try_reserve_exact(count)?;
    list.resize(count, value);
    Ok(list)
}

/// A list of `count` elements, each made by a call of `make`.
pub fn made<T>(count: usize, make: impl FnMut() -> T) -> Room<Vec<T>> {
    let mut list = Vec::new();
    list.try_reserve_exact(count)?;
    list.resize_with(count, make);
    Ok(list)
}

/// A copy of a slice.
pub fn copied<T: Copy>(from: &[T]) -> Room<Vec<T>> {
    let mut list = Vec::new();
    list.try_reserve_exact(from.len())?;
    list.extend_from_slice(from);
    Ok(list)
}

/// A copy of a text.
pub fn copied_text(from: &str) -> Room<String> {
    let mut text = String::new();
    text.try_reserve_exact(from.len())?;
    text.push_str(from);
    Ok(text)
}

/// A list of what `make` makes of each element. Fails if `make` does.
pub fn each<T, R, E: From<TryReserveError>>(
    list: &[T],
    mut make: impl FnMut(&T) -> Result<R, E>,
) -> Result<Vec<R>, E> {
    let mut made = reserved(list.len())?;
    for element in list {
        made.push(make(element)?);
    }
    Ok(made)
}

/// A stable sort.
pub fn stable_sort_by<T: Copy>(list: &mut [T], mut order: impl FnMut(&T, &T) -> Ordering) -> Room<()> {
    let mut numbered = collect(list.iter().copied().enumerate())?;
    numbered.sort_unstable_by(|x, y| order(&x.1, &y.1).then(x.0.cmp(&y.0)));
    list.iter_mut().zip(numbered).for_each(|(place, (_, value))| *place = value);
    Ok(())
}

/// The text that `format!` would make.
pub fn text(arguments: fmt::Arguments<'_>) -> Room<String> {
    let mut out = Text::default();
    // None of our `Display` implementations fails by itself; if one did, the text would end there.
    let _ = out.write_fmt(arguments);
    match out.short {
        Some(error) => Err(error),
        None => Ok(out.text),
    }
}

/// A growing text.
#[derive(Default)]
struct Text {
    text: String,
    /// Set where memory ran out.
    short: Option<TryReserveError>,
}

impl fmt::Write for Text {
    fn write_str(&mut self, more: &str) -> fmt::Result {
        if let Err(error) = self.text.try_reserve(more.len()) {
            self.short = Some(error);
            return Err(fmt::Error);
        }
        self.text.push_str(more);
        Ok(())
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn they_make_what_the_standard_library_makes() {
        assert_eq!(collect((0..100).filter(|i| i % 7 == 0)).unwrap().len(), 15);
        assert_eq!(filled(3u8, 4).unwrap(), [3; 4]);
        assert_eq!(made(2, String::new).unwrap(), ["", ""]);
        assert_eq!(copied(&[1, 2]).unwrap(), [1, 2]);
        assert_eq!(text(format_args!("{} and {:>3}", 1.5, "x")).unwrap(), "1.5 and   x");
        let mut list = [(2, 'a'), (1, 'b'), (2, 'c'), (1, 'd')];
        stable_sort_by(&mut list, |x, y| x.0.cmp(&y.0)).unwrap();
        assert_eq!(list, [(1, 'b'), (1, 'd'), (2, 'a'), (2, 'c')]);
        assert!(filled(0u64, usize::MAX / 16).is_err());
    }
}
