//! Headings as programs write them.

use super::*;

fn found(heading: &str) -> Option<[usize; 3]> {
    axes_of(heading).unwrap().map(|axes| axes.columns)
}

fn axes_of(heading: &str) -> Result<Option<Axes>, HeadingDoubt> {
    let separator = Separator::of(heading.as_bytes());
    let columns = names(heading.as_bytes(), separator).len();
    named_axes(heading.as_bytes(), separator, columns)
}

#[test]
fn programs_call_axes_by_many_names() {
    for heading in [
        "Nx,Ny,Nz,X,Y,Z",
        "R,G,B,x_mm,y_mm,z_mm",
        "\"a\",\"b\",\"c\",\"Points:0\",\"Points:1\",\"Points:2\"",
        "\"Normals_0\",\"Normals_1\",\"Normals_2\",\"Points_0\",\"Points_1\",\"Points_2\"",
        "nx ny nz px py pz",
        "a,b,c,pos_x,pos_y,pos_z",
        "a;b;c;Point X;Point Y;Point Z",
        "a b c x_coord y_coord z_coord",
        "a,b,c,X (\u{b5}m),Y [um],Z_um",
        "nx ny nz X [mm] Y [mm] Z [mm]",
        "px py pz x y z",
    ] {
        assert_eq!(found(heading), Some([3, 4, 5]), "{heading}");
    }
    assert_eq!(found("z_mm,y_mm,x_mm"), Some([2, 1, 0]));
}

#[test]
fn of_several_columns_of_an_axis_those_of_one_unit_count() {
    for (heading, columns, unit) in [
        (
            "x (vox),y (vox),z (vox),x (mm),y (mm),z (mm)",
            [3, 4, 5],
            Some("mm"),
        ),
        ("x_px,y_px,x_mm,y_mm,z_mm", [2, 3, 4], Some("mm")),
        ("x,y,z,x_mm,y_mm,z_mm", [3, 4, 5], Some("mm")),
        ("x_px,y_px,x,y,z", [2, 3, 4], None),
        ("x,y,z,x_world,y_world,z_world", [3, 4, 5], None),
        (
            "Voxel X,Voxel Y,Voxel Z,Physical X,Physical Y,Physical Z",
            [3, 4, 5],
            None,
        ),
        ("X (mm),Y,Z", [0, 1, 2], None),
        ("X (inches),Y (in),Z_inch", [0, 1, 2], Some("inch")),
        ("x_px,y_px,z_px", [0, 1, 2], None),
        ("x_px,y_px,z_px,x,y,z", [3, 4, 5], None),
        ("X [\u{b5}m] Y [um] Z [\u{3bc}m]", [0, 1, 2], Some("um")),
    ] {
        let axes = axes_of(heading).unwrap().unwrap();
        assert_eq!(
            (axes.columns, axes.unit.as_deref()),
            (columns, unit),
            "{heading}"
        );
    }
    for heading in ["x,y,z,x,y,z", "x,y,X,Y,Z", "x_mm,y_mm,z_mm,x_um,y_um,z_um"] {
        assert_eq!(axes_of(heading), Err(HeadingDoubt::Twice), "{heading}");
    }
    for heading in [
        "x [cm],y [cm],z [in]",
        "x_mm,y_mm,z_um",
        "x_px,y_px,z_mm",
        "X (mm),Y (mm),Z (microns)",
    ] {
        let told = axes_of(heading);
        assert!(matches!(told, Err(HeadingDoubt::Units(_))), "{heading}");
    }
}

#[test]
fn sentences_name_no_columns_and_titles_are_no_names() {
    for heading in [
        "exported grain points: x y z",
        "seed 12, coordinates x y z",
        "scan of seed x, y z",
        "points as x y z coordinates",
        "centroid: x 14.74 y -9.18 z 1.40",
        "1 x 2 y 3 z",
    ] {
        assert_eq!(found(heading), None, "{heading}");
    }
    for heading in ["Point X Y Z", "No. x y z", "Point ID\tX\tY\tZ", "\tx\ty\tz"] {
        let named = named_axes(heading.as_bytes(), Separator::Blank, 4);
        assert_eq!(named.unwrap().unwrap().columns, [1, 2, 3], "{heading}");
    }
    let titled = b"Columns: t x y z";
    let axes = named_axes(titled, Separator::Blank, 4).unwrap().unwrap();
    assert_eq!(axes.columns, [1, 2, 3]);
    assert_eq!(named_axes(titled, Separator::Blank, 5), Ok(None));
    assert!(are_elsewhere(titled) && are_elsewhere(b"seed 12, coordinates x y z"));
    assert!(!are_elsewhere(b"grain points: x y z nx") && !are_elsewhere(b"x y of it"));
}

#[test]
fn angles_are_no_lengths() {
    let word = |heading: &str| angle(heading.as_bytes());
    assert_eq!(word("angle_deg,radius,height"), Some("angle".into()));
    assert_eq!(word("theta phi r"), Some("theta".into()));
    assert_eq!(word("Easting,Northing,Elevation"), None);
    assert_eq!(word("East,North,Up,incidence angle"), None);
}

#[test]
fn a_line_of_units_tells_them() {
    let below = |line: &str| units_below(line.as_bytes(), Separator::Byte(b','), [1, 2, 3]);
    assert_eq!(below("s,mm,[mm],millimeters"), Ok(Some("mm".into())));
    assert_eq!(below("s,mm,mm"), Ok(None));
    let units = ["cm", "cm", "inch"].map(String::from);
    assert_eq!(below("s,cm,cm,in"), Err(HeadingDoubt::Units(units.into())));
}

#[test]
fn other_names_are_none() {
    for heading in [
        "nx,ny,nz",
        "x_normal,y_normal,z_normal",
        "x,y,intensity",
        "Normals_0,Normals_1,Normals_2",
        "x,pos_y,z",
    ] {
        assert_eq!(found(heading), None, "{heading}");
    }
    let blank = Separator::Blank;
    assert_eq!(named_axes(b"x y z", blank, 6), Ok(None));
    let reversed = named_axes(b"z,y,x", blank, 3).unwrap().unwrap();
    assert_eq!(reversed.columns, [2, 1, 0]);
}
