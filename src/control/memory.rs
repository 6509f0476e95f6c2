//! The memory account of a run.
//!
//! What counts is the growth of the process's resident memory since the start, which Linux tells in about a microsecond. The large tables
//! of the engine are only a fifth to a third of it: the rest is in lists, copies for attempts, the caller's mesh in the making and what the
//! allocator keeps. An account of tables would not hold within 10 %. The memory is read every millisecond, and before large allocations.
//! Other systems tell nothing without unsafe code: there only the tables that the engine reports count.
use std::cell::Cell;
use std::time::Duration;

/// Time between two readings, which take about a microsecond.
const READING: Duration = Duration::from_millis(1);

/// How much memory the process has taken since the start.
#[derive(Default)]
pub(super) struct Memory {
    resident: Option<Resident>,
    at_start: u64,
    /// Growth at the last reading, and when that was.
    used: Cell<u64>,
    read: Cell<Duration>,
    tables: Cell<u64>,
}

impl Memory {
    /// Counts from here.
    pub(super) fn at_start() -> Memory {
        let resident = Resident::open();
        let at_start = resident.as_ref().and_then(Resident::bytes).unwrap_or(0);
        Memory { resident, at_start, ..Memory::default() }
    }

    /// The growth in bytes, as of the last millisecond; as of now if `exact`.
    pub(super) fn growth(&self, time: Duration, exact: bool) -> u64 {
        if exact || time.saturating_sub(self.read.get()) >= READING {
            self.read.set(time);
            let bytes = self.resident.as_ref().and_then(Resident::bytes);
            self.used.set(bytes.map_or(self.tables.get(), |bytes| bytes.saturating_sub(self.at_start)));
        }
        self.used.get()
    }

    /// The growth at the last reading.
    pub(super) fn used(&self) -> u64 {
        self.used.get()
    }

    /// What the large tables of the engine hold.
    pub(super) fn tables(&self, bytes: u64) {
        self.tables.set(bytes);
    }
}

/// The resident memory of this process, as Linux tells it: a file of counts of pages.
struct Resident {
    #[cfg(target_os = "linux")]
    file: std::fs::File,
    page: u64,
}

impl Resident {
    #[cfg(target_os = "linux")]
    fn open() -> Option<Resident> {
        Some(Resident {
            file: std::fs::File::open("/proc/self/statm").ok()?,
            page: page_size().unwrap_or(4096),
        })
    }

    /// The second number.
    #[cfg(target_os = "linux")]
    fn bytes(&self) -> Option<u64> {
        use std::os::unix::fs::FileExt;
        let mut text = [0; 128];
        let count = self.file.read_at(&mut text, 0).ok()?;
        let text = std::str::from_utf8(text.get(..count)?).ok()?;
        text.split(' ').nth(1)?.parse::<u64>().ok()?.checked_mul(self.page)
    }

    #[cfg(not(target_os = "linux"))]
    fn open() -> Option<Resident> {
        None
    }

    #[cfg(not(target_os = "linux"))]
    fn bytes(&self) -> Option<u64> {
        Some(self.page)
    }
}

/// The size of a page: entry 6 (AT_PAGESZ) of the table of pairs of words that the kernel gives each process.
#[cfg(target_os = "linux")]
fn page_size() -> Option<u64> {
    use std::io::Read;
    const WORD: usize = size_of::<usize>();
    let mut table = [0; 1024];
    let count = std::fs::File::open("/proc/self/auxv").ok()?.read(&mut table).ok()?;
    let word = |bytes: &[u8]| Some(usize::from_ne_bytes(bytes.try_into().ok()?));
    let pairs = table.get(..count)?.chunks_exact(2 * WORD);
    let size = pairs.filter(|pair| word(&pair[..WORD]) == Some(6)).find_map(|pair| word(&pair[WORD..]))?;
    Some(size as u64)
}
