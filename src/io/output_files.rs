//! Output that is written completely or not at all: files get temporary names next to their targets and are renamed when all are complete.
use crate::control::Control;
use crate::error::{Error, Status};
use crate::fallible;
use std::fs::{self, File, OpenOptions};
use std::io::{self, Write};
use std::path::{Path, PathBuf};

/// An error of the file system about `path`.
pub(super) fn file_error(path: &Path, doing: &str, error: &io::Error) -> Error {
    let status = if error.kind() == io::ErrorKind::OutOfMemory { Status::OutOfMemory } else { Status::File };
    if status == Status::OutOfMemory {
        return Error::new(status, "out of memory");
    }
    Error::new(status, format_args!("{}: cannot {doing}: {}", path.display(), Reason(error)))
}

/// Displays a system error without allocating, unlike the standard library.
struct Reason<'a>(&'a io::Error);

impl std::fmt::Display for Reason<'_> {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        let Some(code) = self.0.raw_os_error() else { return write!(f, "{}", self.0) };
        match self.0.kind() {
            io::ErrorKind::NotFound => write!(f, "no such file or folder (os error {code})"),
            kind => write!(f, "{kind} (os error {code})"),
        }
    }
}

/// The files of one output. Dropped before [`OutputFiles::commit`], it removes what was written.
pub(super) struct OutputFiles<'a> {
    control: &'a Control<'a>,
    /// Temporary and final name.
    renames: Vec<(PathBuf, PathBuf)>,
}

impl<'a> OutputFiles<'a> {
    /// No files.
    pub fn new(control: &'a Control<'a>) -> Self {
        OutputFiles { control, renames: Vec::new() }
    }

    /// Writes one file by `fill`.
    pub fn write(&mut self, path: &Path, fill: impl FnOnce(&mut Out) -> io::Result<()>) -> Result<(), Error> {
        let file = self.create(path).map_err(|e| file_error(path, "create", &e))?;
        let mut out = Out { inner: Buffered::new(file, self.control)?, refused: None };
        let written = fill(&mut out).and_then(|()| out.inner.flush());
        // Ended within the file, if it was.
        self.control.look()?;
        written.map_err(|e| match out.refused {
            Some(reason) => {
                Error::new(Status::File, format_args!("{}: cannot write: {reason}", path.display()))
            }
            None => file_error(path, "write", &e),
        })
    }

    /// Moves every file to its place.
    pub fn commit(mut self) -> Result<(), Error> {
        // Where one fails, dropping the list removes what has not been moved.
        self.renames
            .iter()
            .try_for_each(|(from, to)| fs::rename(from, to).map_err(|e| file_error(to, "write", &e)))?;
        self.renames.clear();
        Ok(())
    }

    fn create(&mut self, path: &Path) -> io::Result<File> {
        // A device or pipe is written to, not replaced.
        if fs::metadata(path).is_ok_and(|m| !m.is_file() && !m.is_dir()) {
            return OpenOptions::new().write(true).open(path);
        }
        // A link stays one: what it leads to is replaced.
        let linked = fs::symlink_metadata(path).is_ok_and(|m| m.file_type().is_symlink());
        let target = if linked { fs::canonicalize(path).ok() } else { None };
        let path = target.as_deref().unwrap_or(path);
        let name = path.file_name().ok_or(io::ErrorKind::InvalidInput)?;
        // First, since a file that was made must not be forgotten.
        self.renames.try_reserve(1)?;
        for attempt in 0..100 {
            // Longer than the two numbers and what is between them.
            let mut temporary = copied(path, 64)?;
            temporary.set_file_name(".");
            let text = temporary.as_mut_os_string();
            text.push(name);
            text.push(".");
            text.push(itoa::Buffer::new().format(std::process::id()));
            text.push("-");
            text.push(itoa::Buffer::new().format(attempt));
            text.push(".tmp");
            match OpenOptions::new().write(true).create_new(true).open(&temporary) {
                Err(error) if error.kind() == io::ErrorKind::AlreadyExists => {}
                Err(error) => return Err(error),
                Ok(file) => {
                    match copied(path, 0) {
                        Ok(path) => fallible::push(&mut self.renames, (temporary, path))?,
                        Err(error) => {
                            let _ = fs::remove_file(temporary);
                            return Err(error);
                        }
                    }
                    return Ok(file);
                }
            }
        }
        Err(io::Error::from(io::ErrorKind::AlreadyExists))
    }
}

impl Drop for OutputFiles<'_> {
    fn drop(&mut self) {
        for (temporary, _) in &self.renames {
            let _ = fs::remove_file(temporary);
        }
    }
}

/// A copy of a path with room for `more` bytes.
pub(super) fn copied(path: &Path, more: usize) -> io::Result<PathBuf> {
    let mut copy = PathBuf::new();
    copy.try_reserve(path.as_os_str().len() + more)?;
    copy.push(path);
    Ok(copy)
}

/// A path with another extension, as [`Path::with_extension`].
pub(super) fn with_extension(path: &Path, extension: &str) -> Result<PathBuf, Error> {
    let mut copy = copied(path, extension.len() + 1).map_err(|e| file_error(path, "copy the name", &e))?;
    copy.set_extension(extension);
    Ok(copy)
}

/// A path with a suffix after its last byte.
pub(super) fn with_suffix(path: &Path, suffixes: &[&str]) -> Result<PathBuf, Error> {
    let more = suffixes.iter().map(|suffix| suffix.len()).sum();
    let mut copy = copied(path, more).map_err(|e| file_error(path, "copy the name", &e))?;
    suffixes.iter().for_each(|suffix| copy.as_mut_os_string().push(suffix));
    Ok(copy)
}

/// Collects what is written and passes it on in large pieces. (The standard library's `BufWriter` aborts the process if its buffer
/// cannot be allocated.)
struct Buffered<'a> {
    file: File,
    /// Never longer than its capacity.
    waiting: Vec<u8>,
    control: &'a Control<'a>,
}

impl<'a> Buffered<'a> {
    /// Bytes that are collected.
    const SIZE: usize = 1 << 18;

    fn new(file: File, control: &'a Control<'a>) -> Result<Self, Error> {
        Ok(Buffered { file, waiting: fallible::reserved(Self::SIZE)?, control })
    }

    /// Writes what has no room in the buffer any more.
    #[cold]
    fn write_beyond(&mut self, bytes: &[u8]) -> io::Result<()> {
        self.flush()?;
        ended(self.control)?;
        if bytes.len() > self.waiting.capacity() {
            return self.file.write_all(bytes);
        }
        fallible::append(&mut self.waiting, bytes)?;
        Ok(())
    }
}

impl Write for Buffered<'_> {
    fn write(&mut self, bytes: &[u8]) -> io::Result<usize> {
        self.write_all(bytes)?;
        Ok(bytes.len())
    }

    #[inline]
    fn write_all(&mut self, bytes: &[u8]) -> io::Result<()> {
        if bytes.len() > self.waiting.capacity() - self.waiting.len() {
            return self.write_beyond(bytes);
        }
        fallible::append(&mut self.waiting, bytes)?;
        Ok(())
    }

    fn flush(&mut self) -> io::Result<()> {
        self.file.write_all(&self.waiting)?;
        self.waiting.clear();
        Ok(())
    }
}

/// Stops writing where the run is ended; [`OutputFiles::write`] has the reason.
pub(super) fn ended(control: &Control) -> io::Result<()> {
    control.look().map_err(|_| io::Error::from(io::ErrorKind::Interrupted))
}

/// A buffered writer with fast numbers: doubles in the fewest digits that read back bit for bit.
pub(super) struct Out<'a> {
    inner: Buffered<'a>,
    /// The reason why something cannot be written, if it is not a file system error.
    refused: Option<&'static str>,
}

impl<'a> Out<'a> {
    /// What may end the run.
    pub fn control(&self) -> &'a Control<'a> {
        self.inner.control
    }

    /// Text or bytes as they are.
    pub fn put(&mut self, bytes: impl AsRef<[u8]>) -> io::Result<()> {
        self.inner.write_all(bytes.as_ref())
    }

    /// Formatted text, without a copy of it.
    pub fn format(&mut self, text: std::fmt::Arguments<'_>) -> io::Result<()> {
        self.inner.write_fmt(text)
    }

    /// A double in shortest form. What is not finite is refused.
    pub fn float(&mut self, value: f64) -> io::Result<()> {
        if !value.is_finite() {
            self.refused = Some("a number is not finite");
            return Err(io::Error::from(io::ErrorKind::InvalidInput));
        }
        let mut buffer = zmij::Buffer::new();
        let text = buffer.format_finite(value);
        self.inner.write_all(text.strip_suffix(".0").unwrap_or(text).as_bytes())
    }

    /// An integer.
    pub fn int(&mut self, value: impl itoa::Integer) -> io::Result<()> {
        self.inner.write_all(itoa::Buffer::new().format(value).as_bytes())
    }

    /// A blank and a double.
    pub fn blank_float(&mut self, value: f64) -> io::Result<()> {
        self.inner.write_all(b" ")?;
        self.float(value)
    }

    /// A blank and an integer.
    pub fn blank_int(&mut self, value: impl itoa::Integer) -> io::Result<()> {
        self.inner.write_all(b" ")?;
        self.int(value)
    }

    /// Three coordinates with blanks between.
    pub fn point(&mut self, point: &[f64; 3]) -> io::Result<()> {
        self.float(point[0])?;
        self.blank_float(point[1])?;
        self.blank_float(point[2])
    }
}
