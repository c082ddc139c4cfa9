//! MercuryDPM: clumps in the folders that `LoadClumps` of its `ClumpInput.h` reads. Case matters: before, in its
//! `ClumpIO.h` with `load_clumps`, all of these names were in lower case.

use super::deck::Deck;
use super::file::InputFile;
use super::kind::Kind;
use super::readme::{kinds, readme};
use std::fmt::Write;

pub(super) fn files(deck: &Deck) -> Vec<InputFile<'_>> {
    let mut files: Vec<InputFile<'_>> = deck.kinds.iter().flat_map(clump).collect();
    let first = format!(
        "Clumps for MercuryDPM, of {}: `cp -r Clumps/* MERCURY/Tools/MClump/Clumps/`.",
        kinds(deck)
    );
    files.push(readme(
        deck,
        &first,
        "A driver that includes ClumpInput.h loads them by LoadClumps; older versions, with ClumpIO.h and load_clumps, take \
         the same files under names in lower case. Number of grains, box and contact are the driver's.",
        "",
    ));
    files
}

/// Spheres, mass, inertia and the axes of the moments: x, y and z, for a [`Kind`] lies along them.
fn clump(kind: &Kind) -> [InputFile<'static>; 4] {
    let mut spheres = String::new();
    for ball in &kind.spheres {
        let [x, y, z] = ball.centre.coords.into();
        let _ = writeln!(spheres, "{x:e},{y:e},{z:e},{:e}", ball.radius);
    }
    let [i, j, k] = kind.moments.into();
    let inertia = format!("{i:e},0,0\n0,{j:e},0\n0,0,{k:e}\n");
    let file =
        |name: &str, text: String| InputFile::new(format!("Clumps/{}/{name}", kind.name), text);
    [
        file("Clump/Clump.txt", spheres),
        file("Inertia/Mass.txt", format!("{:e}\n", kind.mass)),
        file("Inertia/TOI.txt", inertia),
        file("Inertia/PD.txt", "1,0,0\n0,1,0\n0,0,1\n".into()),
    ]
}
