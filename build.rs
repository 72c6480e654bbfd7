//! Gives the shared library its soname, from the version in `Cargo.toml`: programs that were linked
//! against one version find, at run time, any later one with the same interface. Before 1.0 that is one
//! with the same minor version, from then on one with the same major version.

use std::path::{Path, PathBuf};
use std::{env, fs, io};

fn main() {
    println!("cargo::rerun-if-changed=build.rs");
    let variable = |name: &str| env::var(name).unwrap_or_default();
    if variable("CARGO_CFG_TARGET_OS") != "linux" {
        return;
    }
    let soname = match (variable("CARGO_PKG_VERSION_MAJOR"), variable("CARGO_PKG_VERSION_MINOR")) {
        (major, minor) if major == "0" => format!("libdeldrift.so.0.{minor}"),
        (major, _) => format!("libdeldrift.so.{major}"),
    };
    println!("cargo::rustc-cdylib-link-arg=-Wl,-soname,{soname}");

    // The name that the loader looks for, beside the library that is not installed yet. A build folder
    // laid out differently only loses this convenience.
    for folder in library_folders(Path::new(&variable("OUT_DIR"))) {
        if let Err(error) = link_to_library(&folder.join(&soname)) {
            println!("cargo::warning={}/{soname}: {error}", folder.display());
        }
    }
}

/// Where cargo puts the shared library: the profile's folder and its `deps`, above
/// `build/deldrift-HASH/out`.
fn library_folders(out: &Path) -> Vec<PathBuf> {
    let profile = out.ancestors().nth(3).unwrap_or(out);
    [profile.to_path_buf(), profile.join("deps")].into_iter().filter(|folder| folder.is_dir()).collect()
}

#[cfg(unix)]
fn link_to_library(link: &Path) -> io::Result<()> {
    if fs::symlink_metadata(link).is_ok() {
        return Ok(());
    }
    std::os::unix::fs::symlink("libdeldrift.so", link)
}

#[cfg(not(unix))]
fn link_to_library(_link: &Path) -> io::Result<()> {
    Ok(())
}
