//! Every program, run with either library.

use std::env;
use std::path::Path;

use crate::support::{
    Linkage, build, command, compiler, fresh_folder, repository, sees_requests, skipped, sources, succeed,
};

#[test]
fn c_programs_run_with_the_shared_library() {
    run_all("c", Linkage::Shared);
}

#[test]
fn c_programs_run_with_the_static_library() {
    run_all("c", Linkage::Static);
}

#[test]
fn cpp_programs_run_with_the_shared_library() {
    run_all("cpp", Linkage::Shared);
}

#[test]
fn cpp_programs_run_with_the_static_library() {
    run_all("cpp", Linkage::Static);
}

/// Programs that tell what they have tried.
const REPORTING: [&str; 5] = ["callbacks.c", "faults.c", "limits.c", "memory_bytes.c", "stack.c"];

/// Builds and runs the programs of a language. All others are silent.
fn run_all(language: &str, linkage: Linkage) {
    let folder = fresh_folder(&format!("{language}-{}", linkage.name()));
    for source in sources(&format!("ffi-tests/{language}"), language) {
        if sees_requests(&source) && matches!(linkage, Linkage::Shared) {
            continue;
        }
        let said = succeed(&mut command(build(&source, &folder, linkage, &[])));
        if source.ends_with("readme_example.c") {
            assert_eq!(triangles_in(&said), [[0, 1, 4], [0, 3, 4], [1, 2, 4], [2, 3, 4]]);
        } else if REPORTING.iter().any(|name| source.ends_with(name)) {
            println!("{said}");
        } else {
            assert_eq!(said, "", "{}", source.display());
        }
    }
}

/// A build with all optimisations inlines more, and its frames are others.
#[test]
#[ignore = "builds the library again"]
fn calls_take_as_little_of_the_stack_when_they_are_optimised() {
    let target = Path::new(env!("CARGO_TARGET_TMPDIR")).parent().expect("it is in the target folder");
    let cargo = env::var_os("CARGO").unwrap_or("cargo".into());
    let options = ["build", "--release", "--lib", "--target-dir"];
    succeed(command(cargo).current_dir(repository(".")).args(options).arg(target));
    let library = target.join("release/libdeldrift.so");
    let source = repository("ffi-tests/c/stack.c");
    let program = fresh_folder("stack").join("stack");
    let run_path = format!("-Wl,-rpath,{}", target.join("release").display());
    succeed(compiler(&source).arg(&source).arg("-o").arg(&program).arg(library).arg(run_path).arg("-lm"));
    println!("{}", succeed(&mut command(program)));
}

/// Two run, with the ranges and spans of the standard library.
#[test]
fn cpp_programs_are_cpp20_too() {
    let folder = fresh_folder("cpp20");
    for source in sources("ffi-tests/cpp", "cpp") {
        succeed(compiler(&source).args(["-std=c++20", "-fsyntax-only"]).arg(source));
    }
    for name in ["ranges", "sequences"] {
        let source = repository(&format!("ffi-tests/cpp/{name}.cpp"));
        let program = build(&source, &folder, Linkage::Shared, &["-std=c++20"]);
        assert_eq!(succeed(&mut command(program)), "");
    }
}

/// Files, messages and what is read have points in their numbers where the program's locale has commas. The locale is made
/// here, so that none needs to be installed.
#[test]
fn numbers_have_points_in_any_locale() {
    let folder = fresh_folder("locale");
    let name = "de_DE.UTF-8";
    let mut make = command("localedef");
    let made = make.args(["-i", "de_DE", "-f", "UTF-8"]).arg(folder.join(name)).output();
    if !made.is_ok_and(|outcome| outcome.status.success()) {
        skipped("numbers under another locale", "localedef, or its source of de_DE, is missing");
        return;
    }
    let program = build(&repository("ffi-tests/cpp/locale.cpp"), &folder, Linkage::Shared, &[]);
    let mut program = command(program);
    succeed(program.env("LOCPATH", &folder).env("DELDRIFT_TEST_LOCALE", name).env_remove("LC_ALL"));
}

/// Programs for CGAL write the same with deldrift in its place.
#[test]
#[ignore = "needs CGAL"]
fn programs_for_cgal_write_the_same() {
    for program in ["both", "constrained", "regular"] {
        let source = repository(&format!("ffi-tests/cgal/{program}.cpp"));
        let run = |name: &str, flags: &[&str]| {
            // CGAL takes a while to compile, less so without optimisation.
            let flags = [flags, &["-O0", "-g0"]].concat();
            let folder = fresh_folder(&format!("{program}_{name}"));
            succeed(&mut command(build(&source, &folder, Linkage::Shared, &flags)))
        };
        // CGAL's headers have warnings of their own, and need libraries of big numbers, here before the program does.
        let cgal = ["-w", "-Wl,--no-as-needed", "-lgmp", "-lmpfr"];
        let with_cgal = run("with_cgal", &[&["-DWITH_CGAL"], &cgal[..]].concat());
        assert!(with_cgal.lines().count() > 4000, "{with_cgal}");
        assert_eq!(run("with_deldrift", &[]), with_cgal);
        assert_eq!(run("with_points_of_cgal", &[&["-DCGAL_KERNEL"], &cgal[..]].concat()), with_cgal);
    }
}

/// Meshes under CGAL's names are as good as CGAL's, and about as small.
#[test]
#[ignore = "needs CGAL"]
fn meshes_have_few_more_faces_than_those_of_cgal() {
    let flags = ["-O1", "-g0", "-w", "-Wl,--no-as-needed", "-lgmp", "-lmpfr"];
    let program =
        build(&repository("ffi-tests/cgal/meshing.cpp"), &fresh_folder("meshing"), Linkage::Shared, &flags);
    let said = succeed(&mut command(program));
    assert!(said.lines().count() > 50, "{said}");
    println!("{said}");
}

/// Conforming triangulations under CGAL's names are conforming by CGAL's questions, and about as small.
#[test]
#[ignore = "needs CGAL"]
fn conforming_triangulations_are_so_for_cgal() {
    let flags = ["-O1", "-g0", "-w", "-Wl,--no-as-needed", "-lgmp", "-lmpfr"];
    let source = repository("ffi-tests/cgal/conforming.cpp");
    let program = build(&source, &fresh_folder("conforming"), Linkage::Shared, &flags);
    let said = succeed(&mut command(program));
    assert!(said.lines().count() > 100, "{said}");
    println!("{said}");
}

/// The example of a solver carries its data to the end, and checks them.
#[test]
fn the_example_of_a_solver_keeps_its_data() {
    let folder = fresh_folder("example");
    let program = build(&repository("examples/solver.c"), &folder, Linkage::Static, &[]);
    let said = succeed(&mut command(program));
    assert!(said.ends_with("mass kept\n"), "{said}");
}

/// The triangles that the example prints, in ascending order.
fn triangles_in(text: &str) -> Vec<[u32; 3]> {
    let triangle = |line: &str| {
        let ids = line.split_whitespace().skip(1).map(|id| id.parse().expect("an id is a number"));
        let mut ids: [u32; 3] = ids.collect::<Vec<_>>().try_into().expect("a triangle has three corners");
        ids.sort_unstable();
        ids
    };
    let mut triangles: Vec<[u32; 3]> = text.lines().map(triangle).collect();
    triangles.sort_unstable();
    triangles
}
