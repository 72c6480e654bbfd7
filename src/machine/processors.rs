//! How many threads the system runs at the same time.
//!
//! The answer is that of [`std::thread::available_parallelism`], which on Linux reads files into memory that cannot be
//! refused; here they are read to the stack.

#![allow(unsafe_code)]

/// The processors that the process may use, as far as can be told, and one at least.
#[cfg(target_os = "linux")]
pub(crate) fn available() -> usize {
    allowed().min(linux::quota()).max(1)
}

/// The processors that the process may use, as far as can be told, and one at least.
#[cfg(not(target_os = "linux"))]
pub(crate) fn available() -> usize {
    std::thread::available_parallelism().map_or(1, |threads| threads.get())
}

/// The processors on which the thread may run; those of the machine where these are too many to be listed.
#[cfg(target_os = "linux")]
fn allowed() -> usize {
    // SAFETY: a set of processors is numbers, for which zeros are fine; the system writes no more than there is room
    // for.
    let (is_listed, n) = unsafe {
        let mut set: libc::cpu_set_t = std::mem::zeroed();
        (libc::sched_getaffinity(0, size_of_val(&set), &mut set) == 0, libc::CPU_COUNT(&set))
    };
    if is_listed {
        return usize::try_from(n).unwrap_or(1);
    }
    // SAFETY: a question without conditions.
    let n = unsafe { libc::sysconf(libc::_SC_NPROCESSORS_ONLN) };
    usize::try_from(n).unwrap_or(1)
}

/// The share of the processors that control groups leave to the process.
#[cfg(target_os = "linux")]
mod linux {
    use std::fs::File;
    use std::io::Read;
    use std::str::from_utf8;

    /// Below this length a path is handed to the system without memory of its own.
    const MOST: usize = 380;

    /// A file's beginning.
    fn read<'b>(path: &str, buffer: &'b mut [u8]) -> Option<&'b str> {
        if path.len() > MOST {
            return None;
        }
        let mut file = File::open(path).ok()?;
        let mut n = 0;
        while n < buffer.len() {
            match file.read(&mut buffer[n..]).ok()? {
                0 => break,
                more => n += more,
            }
        }
        from_utf8(&buffer[..n]).ok()
    }

    /// The parts of a path, put together.
    fn joined<'b>(parts: [&str; 3], buffer: &'b mut [u8; MOST]) -> Option<&'b str> {
        let mut n = 0;
        for part in parts {
            buffer.get_mut(n..n + part.len())?.copy_from_slice(part.as_bytes());
            n += part.len();
        }
        from_utf8(&buffer[..n]).ok()
    }

    /// Processors that the group and those above it have the time of, as far as that is limited.
    pub(super) fn quota() -> usize {
        let mut groups = [0; 4096];
        let Some(groups) = read("/proc/self/cgroup", &mut groups) else { return usize::MAX };
        // The first version's lines are those with the name of a controller; where there is one of its, it decides.
        let (mut is_first_version, mut path) = (false, None);
        for line in groups.lines() {
            let mut fields = line.splitn(3, ':').skip(1);
            let (Some(controllers), Some(group)) = (fields.next(), fields.next()) else { continue };
            if controllers.split(',').any(|controller| controller == "cpu") {
                (is_first_version, path) = (true, Some(group));
                break;
            }
            if controllers.is_empty() {
                path = Some(group);
            }
        }
        let limit: fn(&str, &str) -> Option<usize> = if is_first_version { first_limit } else { limit };
        let mounts = if is_first_version {
            &["/sys/fs/cgroup/cpu", "/sys/fs/cgroup/cpu,cpuacct"][..]
        } else {
            &["/sys/fs/cgroup"][..]
        };
        let mut least = usize::MAX;
        for mount in mounts {
            let mut rest = path;
            while let Some(group) = rest.map(|group| group.trim_end_matches('/')) {
                least = limit(mount, group).unwrap_or(usize::MAX).min(least);
                rest = group.rfind('/').map(|end| &group[..end]);
            }
        }
        least
    }

    fn limit(mount: &str, group: &str) -> Option<usize> {
        let (mut path, mut text) = ([0; MOST], [0; 64]);
        let text = read(joined([mount, group, "/cpu.max"], &mut path)?, &mut text)?;
        let mut numbers = text.split_whitespace().map(str::parse::<usize>);
        numbers.next()?.ok()?.checked_div(numbers.next()?.ok()?)
    }

    fn first_limit(mount: &str, group: &str) -> Option<usize> {
        let number = |name| {
            let (mut path, mut text) = ([0; MOST], [0; 64]);
            let text = read(joined([mount, group, name], &mut path)?, &mut text)?;
            text.trim().parse::<usize>().ok()
        };
        number("/cpu.cfs_quota_us")?.checked_div(number("/cpu.cfs_period_us")?)
    }
}

#[cfg(test)]
mod tests {
    #[test]
    fn they_are_those_of_the_standard_library() {
        let expected = std::thread::available_parallelism().map_or(1, |threads| threads.get());
        assert_eq!(super::available(), expected);
    }
}
