//! Memory use of the process, as the system reports it.

/// The peak resident memory of this process so far in bytes, including the host program's; `None` if the system does not report it.
pub fn peak_resident() -> Option<u64> {
    #[cfg(unix)]
    {
        let mut usage = std::mem::MaybeUninit::<libc::rusage>::zeroed();
        // SAFETY: `usage` is valid for a write of its type.
        if unsafe { libc::getrusage(libc::RUSAGE_SELF, usage.as_mut_ptr()) } != 0 {
            return None;
        }
        // SAFETY: numbers only, for which zeros are valid, and filled by the call.
        let peak = unsafe { usage.assume_init() }.ru_maxrss;
        // Apple counts bytes, all others kilobytes.
        let unit = if cfg!(target_vendor = "apple") { 1 } else { 1024 };
        u64::try_from(peak).ok().and_then(|peak| peak.checked_mul(unit))
    }
    #[cfg(not(unix))]
    None
}

/// The limit on the address space of the process in bytes (`ulimit -v`); `None` if there is no limit or the system does not report one.
pub fn limit() -> Option<u64> {
    #[cfg(unix)]
    {
        let mut limit = libc::rlimit { rlim_cur: 0, rlim_max: 0 };
        // SAFETY: `limit` is valid for a write of its type.
        let known = unsafe { libc::getrlimit(libc::RLIMIT_AS, &mut limit) } == 0;
        #[allow(clippy::unnecessary_cast)] // FreeBSD's numbers are signed.
        (known && limit.rlim_cur != libc::RLIM_INFINITY).then_some(limit.rlim_cur as u64)
    }
    #[cfg(not(unix))]
    None
}
