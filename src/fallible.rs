//! Allocation that returns an error instead of aborting the process, as the standard library's own functions do: a library must not do that
//! to its host. Everything that allocates uses `try_reserve` or one of these functions. They fail if memory runs out.
use std::cmp::Ordering;
use std::collections::TryReserveError;
use std::fmt::{self, Write};

/// A value, unless memory ran out.
type Room<T> = Result<T, TryReserveError>;

/// Appends one element.
#[inline]
pub fn push<T>(list: &mut Vec<T>, value: T) -> Room<()> {
    list.try_reserve(1)?;
    list.push(value);
    Ok(())
}

/// Appends all elements, which may be more than the iterator's lower bound.
pub fn extend<T>(list: &mut Vec<T>, values: impl IntoIterator<Item = T>) -> Room<()> {
    let values = values.into_iter();
    list.try_reserve(values.size_hint().0)?;
    for value in values {
        push(list, value)?;
    }
    Ok(())
}

/// Collects all elements in a list.
pub fn collect<T>(values: impl IntoIterator<Item = T>) -> Room<Vec<T>> {
    let mut list = Vec::new();
    extend(&mut list, values)?;
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
