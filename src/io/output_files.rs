//! Output that appears whole or not at all: files are written under temporary names beside their targets and renamed when
//! all are complete.
use crate::error::{Error, Status};
use std::fs::{self, File, OpenOptions};
use std::io::{self, BufWriter, Write};
use std::path::{Path, PathBuf};

/// An error of the file system about `path`.
pub(super) fn file_error(path: &Path, doing: &str, error: &io::Error) -> Error {
    let status = if error.kind() == io::ErrorKind::OutOfMemory { Status::OutOfMemory } else { Status::File };
    if status == Status::OutOfMemory {
        return Error::new(status, "out of memory");
    }
    Error::new(status, format_args!("{}: cannot {doing}: {error}", path.display()))
}

/// The files of one output. Dropped before [`OutputFiles::commit`], it removes what was written.
#[derive(Default)]
pub(super) struct OutputFiles {
    /// Temporary and final name.
    renames: Vec<(PathBuf, PathBuf)>,
}

impl OutputFiles {
    /// Writes one file by `fill`.
    pub fn write(&mut self, path: &Path, fill: impl FnOnce(&mut Out) -> io::Result<()>) -> Result<(), Error> {
        let file = self.create(path).map_err(|e| file_error(path, "create", &e))?;
        let mut out = Out { inner: BufWriter::with_capacity(1 << 18, file) };
        fill(&mut out).and_then(|()| out.inner.flush()).map_err(|e| file_error(path, "write", &e))
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
        let name = path.file_name().ok_or_else(|| io::Error::other("no file name"))?;
        for attempt in 0..100 {
            let mut temporary = std::ffi::OsString::from(".");
            temporary.push(name);
            temporary.push(format!(".{}-{attempt}.tmp", std::process::id()));
            let temporary = path.with_file_name(temporary);
            match OpenOptions::new().write(true).create_new(true).open(&temporary) {
                Err(error) if error.kind() == io::ErrorKind::AlreadyExists => {}
                Err(error) => return Err(error),
                Ok(file) => {
                    self.renames.push((temporary, path.to_path_buf()));
                    return Ok(file);
                }
            }
        }
        Err(io::Error::other("no free temporary name"))
    }
}

impl Drop for OutputFiles {
    fn drop(&mut self) {
        for (temporary, _) in &self.renames {
            let _ = fs::remove_file(temporary);
        }
    }
}

/// A buffered writer with fast numbers: doubles in the fewest digits that read back bit for bit.
pub(super) struct Out {
    inner: BufWriter<File>,
}

impl Out {
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
            return Err(io::Error::new(io::ErrorKind::InvalidInput, "a number is not finite"));
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
