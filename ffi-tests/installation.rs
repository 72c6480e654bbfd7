//! An installed deldrift, found by programs of someone else's through CMake and through pkg-config; one that is a part of
//! their CMake project; and one that a program in Rust depends on. Needs these tools, so it runs only where it is asked
//! for (`cargo test --test ffi -- --include-ignored`).

use std::collections::BTreeSet;
use std::path::{Path, PathBuf};
use std::process::Command;
use std::sync::{Mutex, MutexGuard, OnceLock, PoisonError};
use std::{env, fs};

use crate::coverage::exported_functions;
use crate::support::{command, fresh_folder, headers, library_folder, repository, succeed, text_of};

#[test]
#[ignore = "needs CMake and pkg-config"]
fn installed_library_is_found() {
    let folder = fresh_folder("installation");
    let prefix = install(&folder);
    programs_find_it_through_cmake(&folder.join("consumers"), &prefix);
    // Wherever it is moved to.
    let moved = folder.join("moved");
    fs::rename(&prefix, &moved).expect("a folder can be moved");
    let libraries = library_files(&moved);
    commands_of_the_page_find_it(&folder, &libraries);
    only_the_header_is_exported(&libraries);
    compat_is_found(&folder, &libraries);
}

/// All files and all folders of deldrift's own, and none of others'; and there is a list to go by, or it is said.
#[test]
#[ignore = "needs CMake"]
fn what_is_installed_can_be_removed() {
    let folder = fresh_folder("uninstall");
    let staging = folder.join("staging");
    let build = installable();
    // What another test has installed is not to be removed here.
    for entry in fs::read_dir(&*build).expect("a folder") {
        let path = entry.expect("an entry").path();
        if path.file_name().is_some_and(|name| name.to_string_lossy().starts_with("install_manifest")) {
            fs::remove_file(path).expect("it can be removed");
        }
    }
    let uninstall = || {
        let mut command = command("cmake");
        command
            .arg(format!("-DBUILD={}", build.display()))
            .arg("-P")
            .arg(repository("cmake/uninstall.cmake"));
        command.env("DESTDIR", &staging);
        command
    };
    let refused = uninstall().output().expect("CMake runs");
    assert!(
        !refused.status.success() && String::from_utf8_lossy(&refused.stderr).contains("install_manifest")
    );
    let mut install = command("cmake");
    install.arg("--install").arg(&*build).args(["--prefix", "/opt/prefix"]);
    succeed(install.env("DESTDIR", &staging));
    let other = library_files(&staging.join("opt/prefix")).join("libother.so");
    fs::write(&other, "").expect("a file can be written");
    succeed(&mut uninstall());
    let left = succeed(command("find").arg(&staging).args(["!", "-type", "d"]));
    assert_eq!(left.trim_end(), other.display().to_string());
    let named = succeed(command("find").arg(&staging).args(["-name", "*deldrift*"]));
    assert_eq!(named, "", "folders that are empty");
    assert!(!uninstall().output().expect("CMake runs").status.success(), "there is nothing left to remove");
}

/// By a component that is asked for, and by none.
#[test]
#[ignore = "needs CMake"]
fn components_are_installed_alone() {
    let folder = fresh_folder("components");
    let files_of = |component: &str| {
        let prefix = folder.join(component);
        let mut install = command("cmake");
        install
            .arg("--install")
            .arg(&*installable())
            .arg("--prefix")
            .arg(&prefix)
            .args(["--component", component]);
        succeed(&mut install);
        let found = succeed(command("find").arg(".").args(["!", "-type", "d"]).current_dir(&prefix));
        found.lines().map(str::to_string).collect::<BTreeSet<_>>()
    };
    let (library, compat) = (files_of("deldrift"), files_of("deldrift_compat"));
    let (runtime, compat_runtime) = (files_of("deldrift_runtime"), files_of("deldrift_compat_runtime"));
    // What programs run with: the file, the name for the loader, and whose it is.
    for (files, name) in [(&runtime, "libdeldrift"), (&compat_runtime, "libdeldrift_triangle_tetgen")] {
        assert_eq!(
            files.iter().filter(|file| file.contains(&format!("/{name}.so.0"))).count(),
            2,
            "{files:?}"
        );
        assert!(files.len() == 3 && files.iter().any(|file| file.ends_with("/copyright")), "{files:?}");
    }
    for file in &runtime {
        let to = folder.join("deldrift").join(file);
        fs::create_dir_all(to.parent().expect("a file is in a folder")).expect("a folder can be made");
        let from = folder.join("deldrift_runtime").join(file);
        succeed(command("cp").arg("-a").arg(from).arg(to));
    }
    let is_of_compat =
        |file: &String| ["triangle", "tetgen", "compat", "Compat"].iter().any(|word| file.contains(word));
    assert!(library.len() > 15 && !library.iter().any(is_of_compat), "{library:?}");
    assert!(compat.len() == 8 && compat.iter().all(is_of_compat), "{compat:?}");
    // One that is not there is missed only by those who ask for it.
    let prefix = format!("-DCMAKE_PREFIX_PATH={}", folder.join("deldrift").display());
    succeed(configure_consumers(&folder.join("without"), None).arg(&prefix));
    let mut asking = configure_consumers(&folder.join("asking"), None);
    let outcome = asking.arg(&prefix).arg("-DWITH_COMPAT=ON").output().expect("CMake runs");
    assert!(!outcome.status.success());
}

/// Where there is an MPI: its files, and a program on two processes that finds them through CMake.
#[test]
#[ignore = "needs CMake, and an MPI to find something"]
fn component_for_several_processes_is_found() {
    if !is_there("mpicc") || !is_there("mpiexec") {
        println!("SKIPPED component mpi: no MPI is installed");
        return;
    }
    let folder = fresh_folder("mpi_component");
    let prefix = install(&folder);
    let found = succeed(command("find").arg(".").args(["!", "-type", "d"]).current_dir(&prefix));
    let is_of_mpi = |file: &&str| file.contains("mpi") || file.contains("Mpi") || file.contains("MPI");
    assert_eq!(found.lines().filter(is_of_mpi).count(), 9, "{found}");
    // For other languages, which cannot call what the header defines.
    let library = library_files(&prefix).join("libdeldrift_mpi.so");
    assert!(exported_symbols(&library, Some("-D")).contains("deldrift_mpi_options_init"));
    let build = folder.join("consumer");
    let mut configure = command("cmake");
    configure.arg("-S").arg(repository("ffi-tests/consumers/mpi")).arg("-B").arg(&build);
    succeed(configure.arg(format!("-DCMAKE_PREFIX_PATH={}", prefix.display())));
    succeed(command("cmake").arg("--build").arg(&build));
    for program in ["program", "static_program"] {
        let mut run = command("mpiexec");
        // More processes than processors, and root, are what Open MPI asks about; others do not know these names.
        let names =
            ["OMPI_ALLOW_RUN_AS_ROOT", "OMPI_ALLOW_RUN_AS_ROOT_CONFIRM", "OMPI_MCA_rmaps_base_oversubscribe"];
        run.envs(names.map(|name| (name, "1"))).args(["-n", "2"]).arg(build.join(program));
        assert!(succeed(&mut run).contains("area of the convex hull: 0.99"));
    }
}

pub fn is_there(program: &str) -> bool {
    Command::new(program).arg("--version").output().is_ok()
}

/// What cargo needs to build the library, and CMake to call it.
const SOURCES: [&str; 14] = [
    "CMakeLists.txt",
    "Cargo.lock",
    "Cargo.toml",
    "benches",
    "build.rs",
    "cmake",
    "deldrift.pc.in",
    "examples",
    "ffi-tests",
    "fuzz",
    "include",
    "soak",
    "src",
    "tests",
];

#[test]
#[ignore = "needs CMake"]
fn library_is_a_part_of_another_project() {
    let folder = fresh_folder("part_of_a_project");
    let archive = folder.join("deldrift.tar.gz");
    succeed(command("tar").arg("-czf").arg(&archive).arg("-C").arg(repository(".")).args(SOURCES));
    for (name, sources) in [("subdirectory", &repository(".")), ("fetched", &archive)] {
        let build = folder.join(name);
        succeed(configure_consumers(&build, Some(sources)).env_remove("CARGO_TARGET_DIR"));
        let mut make = command("cmake");
        in_a_hurry(make.arg("--build").arg(&build));
        if name == "subdirectory" {
            // The folder that is named when the project is built, and not when it is configured.
            let elsewhere = folder.join("elsewhere");
            succeed(make.env("CARGO_TARGET_DIR", &elsewhere));
            assert!(has_cargo_built_below(&elsewhere) && !has_cargo_built_below(&build));
            programs_run(&build);
            // There is nothing to compile again.
            let again = make.output().expect("CMake runs").stderr;
            assert!(!String::from_utf8_lossy(&again).contains("Compiling"));
        } else {
            succeed(&mut make);
            assert!(has_cargo_built_below(&build));
        }
        programs_run(&build);
        only_the_project_is_installed(&build, &build.join("installed"));
    }
}

/// The package for cargo holds what a program needs that depends on it, and no more.
#[test]
#[ignore = "compiles the library again"]
fn program_in_rust_depends_on_the_package() {
    let folder = fresh_folder("crate");
    let cargo = || command(env!("CARGO"));
    let mut pack = cargo();
    pack.args(["package", "--allow-dirty", "--offline", "--no-verify", "--target-dir"]).arg(&folder);
    succeed(pack.current_dir(repository(".")));
    let name = concat!("deldrift-", env!("CARGO_PKG_VERSION"));
    let archive = folder.join(format!("package/{name}.crate"));
    succeed(command("tar").arg("-xzf").arg(archive).arg("-C").arg(&folder));
    the_package_is_sources_and_headers(&folder.join(name));
    let program = folder.join("dependent");
    fs::create_dir(&program).expect("a folder can be made");
    fs::copy(repository("ffi-tests/consumers/dependent.rs"), program.join("main.rs"))
        .expect("it can be copied");
    fs::copy(folder.join(name).join("Cargo.lock"), program.join("Cargo.lock")).expect("it can be copied");
    let manifest = format!(
        "[package]\nname = \"dependent\"\nversion = \"0.0.0\"\nedition = \"2021\"\n\n[[bin]]\nname = \"dependent\"\n\
         path = \"main.rs\"\n\n[dependencies]\ndeldrift = {{ path = \"../{name}\" }}\n\n[workspace]\n"
    );
    fs::write(program.join("Cargo.toml"), manifest).expect("a file can be written");
    let mut run = cargo();
    in_a_hurry(run.args(["run", "--release"]).current_dir(&program));
    assert_eq!(succeed(&mut run), "2 triangles after 3 timestamps\n");
}

fn the_package_is_sources_and_headers(package: &Path) {
    let files_in = |root: &Path, folder: &str| {
        let found = succeed(command("find").arg(folder).args(["-type", "f"]).current_dir(root));
        found.lines().map(str::to_string).collect::<BTreeSet<_>>()
    };
    for folder in ["src", "include"] {
        assert_eq!(files_in(package, folder), files_in(&repository("."), folder));
    }
    let mut rest = files_in(package, ".");
    rest.retain(|file| !file.starts_with("./src/") && !file.starts_with("./include/"));
    // Cargo's own: the manifest as it was, and from which commit it is.
    let of_cargo = ["./.cargo_vcs_info.json", "./Cargo.lock", "./Cargo.toml", "./Cargo.toml.orig"];
    rest.retain(|file| !of_cargo.contains(&file.as_str()));
    let wanted = ["CHANGELOG.md", "LICENSE-APACHE", "LICENSE-MIT", "README.md", "build.rs"];
    assert_eq!(rest, wanted.map(|name| format!("./{name}")).into());
}

/// Has cargo build without a network, and without what makes the library fast.
fn in_a_hurry(command: &mut Command) -> &mut Command {
    let profile = [("OPT_LEVEL", "0"), ("LTO", "off"), ("CODEGEN_UNITS", "16"), ("DEBUG", "0")];
    command.envs(profile.map(|(name, value)| (format!("CARGO_PROFILE_RELEASE_{name}"), value)));
    command.env("CARGO_NET_OFFLINE", "true").env_remove("CARGO_TARGET_DIR").env_remove("RUSTFLAGS")
}

/// Whether cargo has compiled there: beside the libraries it leaves what it compiles them from.
fn has_cargo_built_below(build: &Path) -> bool {
    let found = succeed(command("find").arg(build).args(["-path", "*/release/deps/libdeldrift.so"]));
    found.lines().count() == 1
}

#[test]
#[ignore = "needs CMake, dpkg-dev and pkg-config"]
fn package_for_debian_is_whole() {
    let folder = fresh_folder("package");
    let build = build_for_installation(&folder, Path::new("/usr"));
    succeed(command("cpack").args(["-G", "DEB", "-B"]).arg(&folder).current_dir(&build));
    let of_this_version = |name: &str| format!("{name} (= {})", env!("CARGO_PKG_VERSION"));
    let root = folder.join("root");
    let (library, compat) = ("libdeldrift0.1", "libdeldrift-triangle-tetgen0.1");
    let mut expected = vec![
        (library, library, vec!["Depends: libc6".to_string(), "libgcc-s1".to_string()]),
        ("libdeldrift-dev", "deldrift", vec![of_this_version(library)]),
        (compat, compat, vec!["libstdc++6".to_string()]),
        (
            "libdeldrift-compat-dev",
            "deldrift-compat",
            vec![of_this_version(compat), of_this_version("libdeldrift-dev")],
        ),
    ];
    // Where the originals are installed.
    for (name, needed) in [("libdeldrift-qhull0.1", "libstdc++6"), ("libdeldrift-getfem0.1", "libgetfem")] {
        if has_package(&folder, name) {
            expected.push((name, name, vec![needed.to_string()]));
        }
    }
    for (name, documents, needed) in expected {
        let package = package(&folder, name);
        let fields = succeed(command("dpkg-deb").arg("--field").arg(&package));
        let (name, version) = (format!("Package: {name}\n"), concat!("Version: ", env!("CARGO_PKG_VERSION")));
        for field in [name, version.to_string()].into_iter().chain(needed) {
            assert!(fields.contains(&field), "{field}: {fields}");
        }
        succeed(command("dpkg-deb").arg("--extract").arg(&package).arg(&root));
        assert!(root.join("usr/share/doc").join(documents).join("copyright").is_file());
    }
    let libraries = library_files(&root.join("usr"));
    commands_of_the_page_find_it(&folder, &libraries);
    only_the_header_is_exported(&libraries);
    compat_is_found(&folder, &libraries);
}

/// The file of a package of this version.
fn package(folder: &Path, name: &str) -> PathBuf {
    find_package(folder, name).unwrap_or_else(|| panic!("{name} is not made"))
}

fn has_package(folder: &Path, name: &str) -> bool {
    find_package(folder, name).is_some()
}

fn find_package(folder: &Path, name: &str) -> Option<PathBuf> {
    let begin = format!("{name}_{}_", env!("CARGO_PKG_VERSION"));
    let files = fs::read_dir(folder).expect("the folder is there");
    let mut files = files.map(|entry| entry.expect("so is this").file_name().into_string().expect("ASCII"));
    Some(folder.join(files.find(|file| file.starts_with(&begin) && file.ends_with(".deb"))?))
}

/// Triangle's function, with the shared library of compat and with the static one, by pkg-config.
fn compat_is_found(folder: &Path, libraries: &Path) {
    let source = repository("ffi-tests/consumers/triangle.c");
    let program = folder.join("triangle");
    let shared = "$(pkg-config --cflags --libs deldrift-compat)";
    let of_archives = "s/-ldeldrift/-l:libdeldrift/g; s/\\(-l:[a-z_]*\\)/\\1.a/g";
    let archives = format!("$(pkg-config --static --cflags --libs deldrift-compat | sed '{of_archives}')");
    for (flags, is_static) in [(shared, false), (archives.as_str(), true)] {
        let line = format!("cc {} {flags} -o {}", source.display(), program.display());
        succeed(command("sh").args(["-ec", &line]).env("PKG_CONFIG_PATH", libraries.join("pkgconfig")));
        let mut program = command(&program);
        if !is_static {
            program.env("LD_LIBRARY_PATH", libraries);
        }
        assert_eq!(succeed(&mut program), "2 triangles\n", "{line}");
    }
    let preloaded = libraries.join("libdeldrift_triangle_tetgen.so");
    assert_eq!(exported_symbols(&preloaded, Some("-D")).len(), 6);
}

/// What `make install` does, with the libraries that this test was built with; the prefix.
pub fn install(folder: &Path) -> PathBuf {
    let prefix = folder.join("prefix");
    let build = installable();
    succeed(command("cmake").arg("--install").arg(&*build).arg("--prefix").arg(&prefix));
    prefix
}

/// The folder of all that is to be installed, built once; whoever has it installs alone.
fn installable() -> MutexGuard<'static, PathBuf> {
    static BUILD: OnceLock<Mutex<PathBuf>> = OnceLock::new();
    let make = || {
        let folder = fresh_folder("installable");
        Mutex::new(build_for_installation(&folder, &folder.join("prefix")))
    };
    // A test that has failed has left the folder as it was.
    BUILD.get_or_init(make).lock().unwrap_or_else(PoisonError::into_inner)
}

/// All that is to be installed to a prefix; the folder.
fn build_for_installation(folder: &Path, prefix: &Path) -> PathBuf {
    let build = folder.join("build");
    let mut configure = command("cmake");
    configure.arg("-S").arg(repository(".")).arg("-B").arg(&build);
    configure.arg(format!("-DCMAKE_INSTALL_PREFIX={}", prefix.display()));
    succeed(configure.arg(format!("-DDELDRIFT_LIBRARY_DIR={}", library_folder().display())));
    succeed(command("cmake").arg("--build").arg(&build));
    build
}

/// The folder of the libraries, under all the names that they should have: on Debian below that of the architecture.
pub fn library_files(prefix: &Path) -> PathBuf {
    let architecture = format!("lib/{}-linux-gnu", env::consts::ARCH);
    let mut folders = [architecture.as_str(), "lib", "lib64"].into_iter().map(|name| prefix.join(name));
    let folder = folders.find(|folder| folder.is_dir()).expect("libraries are installed");
    let file = folder.join(format!("libdeldrift.so.{}", env!("CARGO_PKG_VERSION")));
    assert!(file.is_file() && !file.is_symlink() && folder.join("libdeldrift.a").is_file());
    let link = fs::read_link(folder.join("libdeldrift.so")).expect("the name for the linker is a link");
    assert_eq!(folder.join(link), file);
    folder
}

/// The consumers, with the sources of deldrift, or with an installation that they have to find.
fn configure_consumers(build: &Path, sources: Option<&Path>) -> Command {
    let mut configure = command("cmake");
    configure.arg("-S").arg(repository("ffi-tests/consumers")).arg("-B").arg(build);
    if let Some(sources) = sources {
        configure.arg(format!("-DDELDRIFT_FROM={}", sources.display()));
    }
    configure
}

fn programs_find_it_through_cmake(build: &Path, prefix: &Path) {
    let found = format!("-DCMAKE_PREFIX_PATH={}", prefix.display());
    succeed(configure_consumers(build, None).arg(found).arg("-DWITH_COMPAT=ON"));
    succeed(command("cmake").arg("--build").arg(build));
    programs_run(build);
    for program in ["triangle", "static_triangle"] {
        assert_eq!(succeed(&mut command(build.join(program))), "2 triangles\n");
    }
}

fn programs_run(build: &Path) {
    for program in ["c_program", "cpp_program", "static_program"] {
        assert!(succeed(&mut command(build.join(program))).contains("triangle"));
    }
}

fn only_the_project_is_installed(build: &Path, prefix: &Path) {
    succeed(command("cmake").arg("--install").arg(build).arg("--prefix").arg(prefix));
    let installed = succeed(command("find").arg(".").args(["-type", "f"]).current_dir(prefix));
    assert_eq!(installed, "./bin/c_program\n");
}

/// The commands with pkg-config, as docs/BUILDING.md has them.
fn commands_of_the_page_find_it(folder: &Path, libraries: &Path) {
    let solver = folder.join("solver");
    let source = folder.join("solver.c");
    fs::copy(repository("ffi-tests/c/readme_example.c"), source).expect("a file can be copied");
    let page = text_of("docs/BUILDING.md");
    let commands: Vec<&str> = page.lines().filter(|line| line.starts_with("cc solver.c")).collect();
    assert!(commands.len() == 2 && commands[1].contains("--static"), "{commands:?}");
    for (line, is_static) in commands.into_iter().zip([false, true]) {
        let mut shell = command("sh");
        shell.args(["-ec", line]).current_dir(folder).env("PKG_CONFIG_PATH", libraries.join("pkgconfig"));
        succeed(&mut shell);
        let mut program = command(&solver);
        if !is_static {
            program.env("LD_LIBRARY_PATH", libraries);
        }
        assert!(succeed(&mut program).contains("triangle"));
        let needed = succeed(command("readelf").arg("-d").arg(&solver));
        assert_eq!(needed.contains("libdeldrift"), !is_static, "{line}");
        if is_static {
            // Where nothing is shared, not even what unwinds the stack.
            let line = line.replacen("cc ", "cc -static ", 1);
            let mut shell = command("sh");
            shell
                .args(["-ec", &line])
                .current_dir(folder)
                .env("PKG_CONFIG_PATH", libraries.join("pkgconfig"));
            succeed(&mut shell);
            assert!(succeed(&mut command(&solver)).contains("triangle"));
        }
    }
}

/// Nor is there debug information.
fn only_the_header_is_exported(libraries: &Path) {
    let header = headers();
    let declared = exported_functions(&header);
    assert!(declared.len() > 40, "{declared:?}");
    for (library, dynamic) in [("libdeldrift.so", Some("-D")), ("libdeldrift.a", None)] {
        let library = libraries.join(library);
        let exported = exported_symbols(&library, dynamic);
        let exported: BTreeSet<&str> = exported.iter().map(String::as_str).collect();
        assert_eq!(exported, declared, "{}", library.display());
        let sections = succeed(command("readelf").args(["--sections", "--wide"]).arg(&library));
        assert!(sections.contains(".text") && !sections.contains(".debug_"), "{}", library.display());
    }
}

/// The symbols that a library defines for others.
pub fn exported_symbols(library: &Path, dynamic: Option<&str>) -> BTreeSet<String> {
    let mut nm = command("nm");
    nm.args(dynamic).args(["--extern-only", "--defined-only", "--format=posix"]).arg(library);
    let symbols = succeed(&mut nm);
    // Besides the symbols there are lines with the name of a member of the archive.
    let symbols = symbols.lines().filter(|line| !line.ends_with(':'));
    symbols.filter_map(|line| line.split_whitespace().next()).map(str::to_string).collect()
}
