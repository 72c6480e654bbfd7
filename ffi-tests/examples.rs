//! The examples, with few steps. They check themselves; what they print is checked here. Those in C++ need Eigen, and
//! one of them CGAL, so they run only where they are asked for (`cargo test --test ffi -- --include-ignored`).

use std::path::Path;

use crate::support::{Linkage, build, command, fresh_folder, repository, succeed, text_of};

#[test]
#[ignore = "needs Eigen and pkg-config"]
fn the_dam_break_keeps_area_and_loses_energy() {
    let said = run("particle_fem", "examples/particle_fem.cpp", &["1", "0.1"], true);
    assert_eq!(number_after("", &said), 300.0, "{said}");
    // The fluid has come from rest to a speed of at most 2 sqrt(g H), beyond the column's side at 1.
    assert!((1.3..3.8).contains(&number_after("front at ", &said)), "{said}");
    assert!((0.97..1.03).contains(&number_after("area ", &said)), "{said}");
    assert!((0.9..1.0).contains(&number_after("energy ", &said)), "{said}");
}

/// After each step; that particles have come and gone by then shows that the mesh was changed in all ways.
#[test]
#[ignore = "needs Eigen, CGAL and pkg-config"]
fn the_dam_break_has_the_free_surface_that_it_has_with_cgal() {
    let said = run("particle_fem_cgal", "cpp-bench/particle_fem.cpp", &["1.5", "0.1"], false);
    assert!(said.contains("; same free surface after each step\n"), "{said}");
    assert!(number_after(" steps, ", &said) > 20.0 && number_after(" came, ", &said) > 20.0, "{said}");
}

#[test]
#[ignore = "needs Eigen and pkg-config"]
fn stirred_heat_is_kept_and_decays_as_it_should() {
    let said = run("heat", "examples/heat.cpp", &["1000", "25"], true);
    assert!(said.contains("maximum principle kept, rows right\n"), "{said}");
    assert!(number_after("heat drift ", &said) < 1e-9 && number_after("error ", &said) < 0.02, "{said}");
}

#[test]
#[ignore = "needs Eigen and pkg-config"]
fn smoothing_makes_cells_better() {
    let said = run("smoothing", "examples/smoothing.cpp", &["20"], true);
    let qualities: Vec<f64> = said.lines().map(|line| number_after("mean quality ", line)).collect();
    let [random_2d, lloyd_2d, odt_2d, random_3d, lloyd_3d, odt_3d] = qualities[..] else { panic!("{said}") };
    assert!(lloyd_2d.min(odt_2d) > 0.9 && random_2d < 0.8, "{said}");
    assert!(lloyd_3d.min(odt_3d) > random_3d + 0.1, "{said}");
}

#[test]
#[ignore = "needs Eigen and pkg-config"]
fn voronoi_volumes_add_up_and_give_densities() {
    let said = run("densities", "examples/densities.cpp", &["1225"], true);
    let (sum, error) =
        (number_after("sum of volumes within ", &said), number_after("densities within ", &said));
    assert!(sum < 1e-12 && error < 10.0, "{said}");
}

#[test]
#[ignore = "needs Eigen and pkg-config"]
fn an_incompressible_fluid_keeps_its_vortex_and_its_energy() {
    let said = run("euler", "examples/euler.cpp", &["900"], true);
    let number = |before: &str| number_after(before, &said);
    assert!(number("energy within ") < 0.03 && number("velocities off by ") < 0.3, "{said}");
    assert!(number("150 steps: ") < 8.0, "{said}");
}

#[test]
#[ignore = "needs Eigen and pkg-config"]
fn power_cells_have_the_areas_that_are_wanted() {
    let said = run("transport", "examples/transport.cpp", &["500"], true);
    let number = |before: &str| number_after(before, &said);
    assert!(number("areas within ") < 1e-6 && number("sum of areas within ") < 1e-12, "{said}");
    assert!(number("mean after ") < 20.0, "{said}");
}

/// Small discs within large ones are hidden, and come out; then all grow as far as they can.
#[test]
#[ignore = "needs Eigen and pkg-config"]
fn discs_grow_until_they_touch() {
    let said = run("packing", "examples/packing.cpp", &["120"], true);
    let number = |before: &str| number_after(before, &said);
    assert!(number("at random: ") > 3.0 && number("discs cover ") > 0.78, "{said}");
    assert!(number("of the square; ") > 120.0, "{said}");
    assert!(said.ends_with("of all pairs 0 overlap, and 0 touch that are no neighbours\n"), "{said}");
}

/// What is known of twenty hexagons and twelve pentagons: each has a void below it while the atom in the middle touches the
/// cage, then there is one void, then tunnels through the hexagons, through all of them, and atoms apart.
#[test]
#[ignore = "needs Eigen and pkg-config"]
fn a_growing_cage_of_atoms_opens() {
    let said = run("molecule", "examples/molecule.cpp", &["34"], true);
    let shapes: Vec<[f64; 4]> = said
        .lines()
        .filter(|line| line.contains(" times as large: "))
        .map(|line| ["pieces ", "tunnels ", "voids ", "atoms "].map(|before| number_after(before, line)))
        .collect();
    let known = [[1, 0, 0], [1, 0, 32], [2, 0, 1], [2, 19, 0], [2, 31, 0], [61, 0, 0]];
    let known = known.map(|[pieces, tunnels, voids]: [i32; 3]| [pieces, tunnels, voids, 0].map(f64::from));
    assert_eq!(shapes, known, "{said}");
}

#[test]
#[ignore = "needs Eigen and pkg-config"]
fn a_gas_of_voronoi_cells_comes_to_rest() {
    let said = run("gas", "examples/gas.cpp", &["196", "900"], true);
    let number = |before: &str| number_after(before, &said);
    assert!(number("sum of areas within ") < 1e-12 && number("energy fell by ") > 1.0, "{said}");
    assert!(number("forces are differences of energy within ") < 1e-6, "{said}");
    assert!(number("pressures within ") < 0.02, "{said}");
}

#[test]
fn the_tour_sees_what_it_expects() {
    let folder = fresh_folder("tour");
    let said = succeed(&mut command(build(&repository("examples/tour.c"), &folder, Linkage::Static, &[])));
    let (found, expected) = (number_after("bytes: ", &said), number_after(" of ", &said));
    assert!(found == expected && expected > 15.0 && said.lines().count() == 1, "{said}");
}

/// With the mask there are as many cells at each angle, and the temperature is the one that is known.
#[test]
fn the_turned_plate_has_its_temperature_without_flat_cells() {
    let folder = fresh_folder("plate");
    let said = succeed(&mut command(build(&repository("examples/plate.c"), &folder, Linkage::Static, &[])));
    let rows: Vec<Vec<f64>> = said
        .lines()
        .skip(1)
        .map(|line| line.split([' ', ',']).filter_map(|field| field.parse().ok()).collect())
        .collect();
    assert_eq!(rows.len(), 6, "{said}");
    for row in &rows {
        let [_, cells, flat, greatest, rounds, error, _, error_of_all] = row[..] else { panic!("{said}") };
        assert_eq!(cells - flat, 3200.0, "{said}");
        assert!(rounds < 200.0 && error < 1e-9 && greatest < 1e-12, "{said}");
        assert!(flat == 0.0 || flat > 100.0 && error_of_all > 1e-3, "{said}");
    }
}

/// No dye is lost or gained but what rounding makes of it, and no more of it is anywhere than there was.
#[test]
fn stirred_dye_stays() {
    let said = run("stirred", "examples/stirred.c", &[], true);
    assert_eq!(said.lines().count(), 6, "{said}");
    for row in said.lines() {
        let [dye, least, greatest] = [" dye ", " from ", " to "].map(|word| number_after(word, row));
        let [lost, gained] = ["lost ", "gained "].map(|word| number_after(word, row));
        assert!(lost < 1e-13 && gained < 1e-13 && (dye - 0.5).abs() < 0.01, "{said}");
        assert!((0.0..=1.0).contains(&least) && (0.0..=1.0).contains(&greatest), "{said}");
    }
}

/// Some steps are rejected, and leave no trace; the areas add up.
#[test]
fn rejected_steps_leave_all_as_it_was() {
    let folder = fresh_folder("rejecting");
    let said =
        succeed(&mut command(build(&repository("examples/rejecting.c"), &folder, Linkage::Static, &[])));
    let (as_before, rejected) =
        (number_after("after ", &said), number_after(" of ", said.lines().last().expect("two lines")));
    assert!(as_before == rejected && rejected > 3.0, "{said}");
    assert!(
        number_after("particles, ", &said) > 0.0 && number_after("area within ", &said) < 1e-12,
        "{said}"
    );
}

/// The cells fill the box, forces are mutual across its border, and another basis changes nothing.
#[test]
fn the_sheared_box_keeps_its_area_and_its_momentum() {
    let folder = fresh_folder("periodic");
    let program = build(&repository("examples/periodic.c"), &folder, Linkage::Static, &[]);
    let picture = folder.join("picture.svg");
    let said = succeed(command(program).arg(&picture));
    assert!(number_after("area within ", &said) < 1e-12, "{said}");
    assert!(number_after("momentum within ", &said) < 1e-12, "{said}");
    assert!(said.contains("after 2 of 2 changes"), "{said}");
    let drawn = std::fs::read_to_string(&picture).expect("the example has written it");
    assert!(drawn.starts_with("<svg ") && drawn.ends_with("</svg>\n") && drawn.len() < 100_000);
}

/// Its area is that of the box less rotor and pipe, as much heat leaves as comes, and the mesh keeps its quality and its
/// number of vertices.
#[test]
fn the_domain_with_a_rotor_keeps_its_area_its_heat_and_its_mesh() {
    let folder = fresh_folder("domain");
    let program = build(&repository("examples/domain.c"), &folder, Linkage::Static, &[]);
    let (picture, page) = (folder.join("picture.svg"), folder.join("page.html"));
    let said = succeed(command(program).arg("300").arg(&picture).arg(&page));
    let vertices: Vec<f64> = said
        .lines()
        .filter_map(|line| line.split_once(": ")?.1.strip_suffix(" vertices")?.parse().ok())
        .collect();
    assert_eq!(vertices.len(), 11, "{said}");
    assert!(vertices.iter().all(|n| (0.9..1.1).contains(&(n / vertices[0]))), "{said}");
    let last = said.lines().last().expect("it says something");
    assert!(last.starts_with("300 steps"), "{said}");
    assert!(number_after("least angle ", last) >= 25.0, "{said}");
    assert!(number_after("area within ", last) < 1e-12, "{said}");
    assert!(number_after("heat within ", last) < 1e-12, "{said}");
    assert!(number_after("had changed ", last) < 1e-4, "{said}");
    let drawn = std::fs::read_to_string(&picture).expect("the example has written it");
    assert!(drawn.starts_with("<svg ") && drawn.ends_with("</svg>\n") && drawn.len() < 300_000);
    assert_eq!((drawn.matches("class='b'").count(), drawn.matches("zM").count()), (3, 6), "{said}");
    let drawn = std::fs::read_to_string(&page).expect("the example has written it");
    assert_eq!(drawn.matches("<g class='frame'").count(), 61, "{said}");
    assert!(drawn.starts_with("<!doctype html>") && drawn.ends_with("</html>\n") && drawn.len() < 5_000_000);
}

/// Vertices, ids and memory do not grow, as the program checks; all its dye is between none and full.
#[test]
fn a_mesh_lives_through_a_night() {
    let folder = fresh_folder("overnight");
    let program = build(&repository("examples/overnight.c"), &folder, Linkage::Static, &[]);
    let picture = folder.join("picture.svg");
    let said = succeed(command(program).arg("2000").arg(&picture));
    assert_eq!(said.lines().filter(|line| line.starts_with("step ")).count(), 11, "{said}");
    assert!(said.ends_with("0 bad cells in 2000 steps, dye from 0.00 to 1.00\n"), "{said}");
    let drawn = std::fs::read_to_string(&picture).expect("the example has written it");
    assert!(drawn.starts_with("<svg ") && drawn.ends_with("</svg>\n") && drawn.len() < 200_000);
    assert_eq!(drawn.matches("<g ").count(), 3);
    // Fewer steps than there are lines are none.
    assert_eq!(command(folder.join("overnight")).arg("9").status().expect("it runs").code(), Some(2));
}

#[test]
fn algorithms_of_research_have_the_same_triangles() {
    let folder = fresh_folder("comparison");
    let source = repository("examples/comparison.c");
    let said = succeed(&mut command(build(&source, &folder, Linkage::Shared, &[])));
    let within = |name, what| {
        let line = said.lines().find(|line| line.starts_with(name)).expect("a line for each");
        line.split(", ").find_map(|part| part.strip_suffix(what)?.split_whitespace().last()?.parse().ok())
    };
    assert_eq!(within("placement", " within safe region"), Some(0), "{said}");
    assert!(within("safe region", " within safe region") > Some(1000), "{said}");
    assert!(said.ends_with("4 of 4 have the same triangles\n"), "{said}");
}

/// The program of docs/FIVE_MINUTES.md, as it stands there.
#[test]
fn the_program_of_the_first_page_runs() {
    let page = text_of("docs/FIVE_MINUTES.md");
    let (_, program) = page.split_once("```c\n").expect("there is a program");
    let (program, _) = program.split_once("```").expect("a program ends");
    let folder = fresh_folder("five_minutes");
    let source = folder.join("program.c");
    std::fs::write(&source, program).expect("a source can be written");
    let said = succeed(&mut command(build(&source, &folder, Linkage::Shared, &[])));
    let (new, all) = (number_after("", &said), number_after(" of ", &said));
    assert!(said.ends_with(" triangles were new\n") && 0.0 < new && new < all / 10.0, "{said}");
}

/// Builds an example and runs it; what it says. One that draws is asked to, and its picture must be small.
fn run(name: &str, source: &str, arguments: &[&str], draws: bool) -> String {
    let folder = fresh_folder(name);
    let eigen = eigen();
    let mut flags: Vec<&str> = eigen.iter().map(String::as_str).collect();
    if !draws {
        flags.extend(["-DNDEBUG", "-Wl,--no-as-needed", "-lgmp", "-lmpfr"]);
    }
    let program = build(&repository(source), &folder, Linkage::Static, &flags);
    let picture = folder.join("picture.svg");
    let mut command = command(program);
    command.args(arguments);
    if draws {
        command.arg(&picture);
    }
    let said = succeed(&mut command);
    if draws {
        is_a_picture(&picture);
    }
    said
}

fn is_a_picture(path: &Path) {
    let picture = std::fs::read_to_string(path).expect("the example has written it");
    assert!(picture.starts_with("<svg ") && picture.ends_with("</svg>\n"), "{}", path.display());
    assert!(picture.contains("<path") && picture.len() < 200_000, "{} bytes", picture.len());
}

/// Where Eigen's headers are, as flags that keep the compiler from warning of what is in them.
fn eigen() -> Vec<String> {
    let folders = succeed(command("pkg-config").args(["--cflags-only-I", "eigen3"]));
    folders
        .split_whitespace()
        .flat_map(|flag| ["-isystem".into(), flag.trim_start_matches("-I").into()])
        .collect()
}

/// The number that follows these words.
fn number_after(words: &str, text: &str) -> f64 {
    let at = text.find(words).unwrap_or_else(|| panic!("no \"{words}\" in \"{text}\"")) + words.len();
    let number = text[at..].split([' ', ',', ';', '\n']).next().expect("a split has a first part");
    number.parse().unwrap_or_else(|_| panic!("{number} after \"{words}\" in \"{text}\""))
}
