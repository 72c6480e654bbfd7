//! The bindings for Fortran, Julia and C#: what the headers say, and programs that call them.

use std::fs;
use std::path::Path;
use std::process::Command;

use crate::coverage::exported_functions;
use crate::installation::is_there;
use crate::support::{command, fresh_folder, headers, library_folder, repository, skipped, succeed, text_of};

#[test]
#[ignore = "needs Python 3.11"]
fn bindings_are_what_the_headers_say() {
    succeed(command(repository("bindings/generate")).arg("--check"));
    let files = ["fortran/deldrift.f90", "julia/LibDeldrift.jl", "csharp/Deldrift.cs"];
    let text = headers();
    // Structures have their defaults there.
    for name in exported_functions(&text).into_iter().filter(|name| !name.ends_with("_init")) {
        for file in files {
            assert!(
                text_of(&format!("bindings/{file}")).contains(&format!("{name}(")),
                "{name} is not in {file}"
            );
        }
    }
}

#[test]
#[ignore = "needs gfortran"]
fn a_program_in_fortran_calls_the_library() {
    if !is_there("gfortran") {
        skipped("bindings for Fortran", "gfortran is not installed");
        return;
    }
    let folder = fresh_folder("fortran");
    let build = |source: &Path, to: &Path| {
        let mut compile = command("gfortran");
        compile.args(["-std=f2018", "-Wall", "-Wextra", "-Werror", "-fcheck=all"]).arg("-J").arg(&folder);
        compile.arg(repository("bindings/fortran/deldrift.f90")).arg(source).arg("-o").arg(to);
        succeed(compile.arg("-L").arg(library_folder()).arg("-ldeldrift"));
    };
    let program = folder.join("test");
    build(&repository("bindings/fortran/test.f90"), &program);
    assert_eq!(succeed(&mut running(command(&program))), "passed\n");

    // Structures are as large as those of C.
    let module = text_of("bindings/fortran/deldrift.f90");
    let names: Vec<&str> =
        module.lines().filter_map(|line| line.trim().strip_prefix("type, bind(c) :: ")).collect();
    assert!(names.len() > 10, "{names:?}");
    let declared: String = names.iter().map(|name| format!("type({name}) :: of_{name}\n")).collect();
    let asked: String = names.iter().map(|name| format!("print '(i0)', c_sizeof(of_{name})\n")).collect();
    let (of_fortran, of_c) = (folder.join("sizes.f90"), folder.join("sizes.c"));
    let text = format!("program sizes\nuse deldrift\nimplicit none\n{declared}{asked}end program\n");
    fs::write(&of_fortran, text).expect("it is written");
    let asked: String = names.iter().map(|name| format!("printf(\"%zu\\n\", sizeof({name}));\n")).collect();
    let text = format!(
        "#include <deldrift.h>\n#include <deldrift/research.h>\n#include <stdio.h>\nint main(void) {{\n{asked}}}\n"
    );
    fs::write(&of_c, text).expect("it is written");
    build(&of_fortran, &folder.join("in_fortran"));
    let mut compile = command("cc");
    succeed(compile.arg("-I").arg(repository("include")).arg(&of_c).arg("-o").arg(folder.join("in_c")));
    let in_c = succeed(&mut command(folder.join("in_c")));
    assert_eq!(succeed(&mut running(command(folder.join("in_fortran")))), in_c);
}

#[test]
#[ignore = "needs Mono"]
fn a_program_in_csharp_calls_the_library() {
    if !is_there("mcs") || !is_there("mono") {
        skipped("bindings for C#", "mcs and mono are not installed");
        return;
    }
    let program = fresh_folder("csharp").join("test.exe");
    let sources = ["Deldrift.cs", "Test.cs"].map(|name| repository("bindings/csharp").join(name));
    succeed(command("mcs").args(sources).arg(format!("-out:{}", program.display())));
    assert_eq!(succeed(running(command("mono")).arg(&program)), "passed\n");
}

/// A program that finds the library.
fn running(mut program: Command) -> Command {
    program.env("LD_LIBRARY_PATH", library_folder());
    program
}
