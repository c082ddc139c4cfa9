//! Tables as programs and people write them.

use super::*;

fn first(text: &str) -> [f64; 3] {
    parse(text.as_bytes()).unwrap().points[0].into()
}

#[test]
fn any_separator_and_extra_columns_are_read() {
    for text in [
        "1 2 3",
        " 1\t2  3 9",
        "1,2,3",
        "1, 2, 3, 9",
        "1;2;3;",
        "1; 2; 3",
    ] {
        assert_eq!(first(text), [1.0, 2.0, 3.0], "{text}");
    }
}

#[test]
fn headings_name_the_columns() {
    assert_eq!(first("id,x,y,z\n7,1,2,3"), [1.0, 2.0, 3.0]);
    assert_eq!(
        first("\"Z (mm)\";\"Y (mm)\";\"X (mm)\"\n3;2;1"),
        [1.0, 2.0, 3.0]
    );
    assert_eq!(first("x_normal,x,y,z\n7,1,2,3"), [1.0, 2.0, 3.0]);
    assert_eq!(first("x,y,z\nmm,mm,mm\n1,2,3"), [1.0, 2.0, 3.0]);
    assert_eq!(first("1\nz y x\n3 2 1"), [1.0, 2.0, 3.0]);
    assert_eq!(first("sep=;\nz;y;x\n3;2;1"), [1.0, 2.0, 3.0]);
    for heading in ["east north up", "X [mm] Y [mm] Z [mm]", "x,y,z"] {
        let scan = parse(format!("{heading}\n1 2 3 4").as_bytes()).unwrap();
        assert_eq!(scan.points[0], [1.0, 2.0, 3.0].into());
        assert!(
            scan.warnings[0].contains("first three"),
            "{:?}",
            scan.warnings
        );
    }
}

#[test]
fn remarks_name_the_columns_too() {
    for heading in [
        "# nx ny nz x y z",
        "//Nx Ny Nz X Y Z",
        "#nx\tny\tnz\tx\ty\tz",
        "% saved by hand\n## r g b pos_x pos_y pos_z",
        "# nx,ny,nz,x,y,z",
        "# nx ny nz x y z\n# 1 row",
    ] {
        let scan = parse(format!("{heading}\n7 8 9 1 2 3").as_bytes()).unwrap();
        assert_eq!(scan.points[0], [1.0, 2.0, 3.0].into(), "{heading}");
        assert_eq!(scan.warnings, [""; 0], "{heading}");
    }
    assert_eq!(first("# z,y,x\n3,2,1"), [1.0, 2.0, 3.0]);
    for remark in ["# x y z", "# z y x and more", "// east north up a b c"] {
        let text = format!("{remark}\n1 2 3 7 8 9");
        assert_eq!(first(&text), [1.0, 2.0, 3.0], "{remark}");
    }
    assert_eq!(
        first("# w x y z\neast north up w\n1 2 3 7"),
        [1.0, 2.0, 3.0]
    );
    let heading = "# x y z w\nw x y z\n7 1 2 3";
    assert_eq!(first(heading), [1.0, 2.0, 3.0]);
}

/// Rows of normals and what follows them.
fn normals(tail: &str) -> String {
    let rows = (0..9).map(|row| {
        let (sin, cos) = f64::from(row).sin_cos();
        format!("{cos:.4} {sin:.4} 0 {tail}\n")
    });
    rows.collect()
}

#[test]
fn normals_are_no_coordinates_unless_they_are_named_so() {
    let told = parse(normals("5 6 7").as_bytes()).unwrap_err().to_string();
    assert!(
        told.starts_with("line 1:") && told.contains("as normals are"),
        "{told}"
    );
    let named = format!("# x y z r g b\n{}", normals("5 6 7"));
    assert_eq!(first(&named), [1.0, 0.0, 0.0]);
    let named = format!("nx ny nz x y z\n{}", normals("5 6 7"));
    assert_eq!(first(&named), [5.0, 6.0, 7.0]);
    assert_eq!(first(&normals("5 6")), [1.0, 0.0, 0.0]);
    let sphere_and_a_point = format!("{}2 0 0 5 6 7", normals("5 6 7"));
    assert_eq!(first(&sphere_and_a_point), [1.0, 0.0, 0.0]);
    // Of a ball, whose normals come next.
    assert_eq!(first(&normals("0.6 0 -0.8")), [1.0, 0.0, 0.0]);
}

/// With two digits, as whole numbers of 8 bits, and unknown in one row of forty.
#[test]
fn normals_are_known_as_they_are_written() {
    let rows = |write: fn(f64, f64) -> String| {
        let of_row = |row: i32| {
            let (sin, cos) = f64::from(row).sin_cos();
            let normal = if row == 0 {
                "0 0 0".into()
            } else {
                write(cos, sin)
            };
            format!("{normal} {row} 6 7\n")
        };
        (0..40).map(of_row).collect::<String>()
    };
    let written: [fn(f64, f64) -> String; 2] = [
        |cos, sin| format!("{:.2} {:.2} {sin:.2}", cos * 0.6, cos * 0.8),
        |cos, sin| format!("{:.0} {:.0} 0", 127.0 * cos, 127.0 * sin),
    ];
    for write in written {
        let told = parse(rows(write).as_bytes()).unwrap_err().to_string();
        assert!(told.contains("as normals are"), "{told}");
    }
    let of_radius_127 = rows(|cos, sin| format!("{} {} 0", 127.0 * cos, 127.0 * sin));
    assert!(parse(of_radius_127.as_bytes()).is_ok());
}

#[test]
fn an_error_after_an_unread_heading_tells_of_it() {
    for rows in ["1 2 3\n1 2", "0 1 2 9\n1 3 2 9\n2 5 7 9\n3 1 0 9"] {
        let error = parse(format!("east north up\n{rows}").as_bytes()).unwrap_err();
        let told = error.to_string();
        assert!(
            told.starts_with("line ") && told.contains(". The heading `east north up` does"),
            "{told}"
        );
    }
}

#[test]
fn numbers_may_be_quoted_and_have_the_exponents_of_fortran() {
    assert_eq!(first("\"1.5\",\"2\",\"3\""), [1.5, 2.0, 3.0]);
    assert_eq!(first("1.5D+00 -2d1 3.D-1"), [1.5, -20.0, 0.3]);
    for text in ["\"1,5\",\"2,5\",\"3,5\"", "D 1 2", "1D 2 3"] {
        assert!(parse(text.as_bytes()).is_err(), "{text}");
    }
}

#[test]
fn commas_that_separate_columns_and_decimals_are_refused() {
    let text = "x,y,z\n2,8623,-2,4778,0,1\n3,34,-2,0957,-0,35";
    let told = parse(text.as_bytes()).unwrap_err().to_string();
    assert!(
        told.starts_with("line 2: expected numbers with decimal points"),
        "{told}"
    );
    assert_eq!(first("2,8,-2,4,0,10\n3,34,-2,0,1,35"), [2.0, 8.0, -2.0]);
    assert_eq!(first("2,08,-2,4,0,1.5"), [2.0, 8.0, -2.0]);
}

#[test]
fn decimal_commas_are_named_wherever_they_stand() {
    for rows in [
        "1,09 2,5 3",
        "1,09\t2,5\t-3,1",
        "1\t2\t3\n1,09\t2\t3",
        "1,5;2,5;3,5",
        "\"1,09\",\"2,5\",\"3,1\"",
        "\"1,09\",\"2,5\",3",
        "\"1,09\" \"2,5\" \"3\"",
        "1,9,2,5,3,1",
        "1,09,2,5,3,1",
    ] {
        for heading in ["x,y,z", "X\tY\tZ", "\"X\";\"Y\";\"Z\""] {
            let text = format!("{heading}\n{rows}");
            let told = parse(text.as_bytes()).unwrap_err().to_string();
            assert!(
                told.contains("write points") && !told.contains("heading"),
                "{text}: {told}"
            );
        }
    }
    for rows in ["1, 2, 3, 4\n1, 2, 3", "1 2 3\n1,5 2", "1,000.5 2 3"] {
        let told = parse(rows.as_bytes()).unwrap_err().to_string();
        assert!(!told.contains("write points"), "{rows}: {told}");
    }
    assert_eq!(first("x,y,z,note\n1,2,3,\"4,5\""), [1.0, 2.0, 3.0]);
}

#[test]
fn separators_of_thousands_are_named() {
    for rows in [
        "1.234,50;2;3",
        "5.453,05 2,5 3,1",
        "1 2 3\n5,453.05\t2\t-3.5",
        "\"5,453.05\",\"-12,000.1\",\"3\"",
        "1 2 3\n-1,234,567 2 3",
    ] {
        let told = parse(rows.as_bytes()).unwrap_err().to_string();
        assert!(told.contains("separators of thousands"), "{rows}: {told}");
    }
    for rows in ["1.2.3 2 3", "1,23.5 2 3", "1,2345.6 2 3", "a 5,453.05 2"] {
        let told = parse(format!("0 0 0\n{rows}").as_bytes())
            .unwrap_err()
            .to_string();
        assert!(!told.contains("thousands"), "{rows}: {told}");
    }
}

#[test]
fn a_heading_that_names_axes_is_not_said_to_name_none() {
    let scan = parse(b"x,y,z\n1,2,3,4").unwrap();
    let expected =
        "The heading `x,y,z` names 3 columns, but the first row has 4; the first three were read.";
    assert_eq!(scan.warnings, [expected]);
}

#[test]
fn a_column_that_counts_the_rows_is_no_coordinate() {
    for first in [0, 1] {
        let rows = (0..9).map(|row| format!("{} 0.5 {row}.25 -1\n", first + row));
        let error = parse(rows.collect::<String>().as_bytes()).unwrap_err();
        let told = error.to_string();
        assert!(
            told.starts_with("line 1:") && told.contains("counts the rows"),
            "{told}"
        );
    }
    let rows = (0..9).map(|row| format!("{row} 0.5 {row}.25 -1\n"));
    let named = format!("id x y z\n{}", rows.collect::<String>());
    assert_eq!(first(&named), [0.5, 0.25, -1.0]);
    let grid = (0..9).map(|row| format!("{row} 0.5 0\n"));
    assert!(parse(grid.collect::<String>().as_bytes()).is_ok());
}

/// Rows of a ball behind a column.
fn behind(column: impl Fn(u32) -> f64) -> String {
    let rows = (0..60).map(|row| {
        let (sin, cos) = f64::from(row).sin_cos();
        let z = f64::from(row).mul_add(0.03, -0.9);
        format!("{} {cos:.4} {sin:.4} {z:.4}\n", column(row))
    });
    rows.collect()
}

#[test]
fn columns_of_numbers_and_times_are_no_coordinates() {
    let columns: [fn(u32) -> f64; 6] = [
        |row| f64::from(row) * 0.004,
        |row| 1.7e9 + f64::from(row) * 0.1,
        |row| f64::from(1 + row / 20),
        |row| f64::from(60 - row),
        |row| f64::from(10 * row + u32::from(row > 30)),
        |row| f64::from(row + 100_000),
    ];
    for column in columns {
        let told = parse(behind(column).as_bytes()).unwrap_err().to_string();
        assert!(told.contains("from row to row"), "{told}");
        let named = format!("# t x y z\n{}", behind(column));
        assert_eq!(first(&named), [1.0, 0.0, -0.9]);
    }
    // Points in the order of x, in steps of all lengths.
    let sorted = behind(|row| f64::from(row).powf(1.3));
    assert!(parse(sorted.as_bytes()).is_ok());
    let turning = behind(|row| f64::from(row % 30));
    assert!(parse(turning.as_bytes()).is_ok());
}

#[test]
fn a_remark_that_names_axes_in_a_sentence_is_told() {
    let rows = "1 2 3 7 8 9";
    for remark in ["# seed 12, coordinates x y z", "# t x y z"] {
        let scan = parse(format!("{remark}\n{rows}").as_bytes()).unwrap();
        assert_eq!(scan.points[0], [1.0, 2.0, 3.0].into());
        assert!(scan.warnings[0].contains("names x, y and z"), "{remark}");
    }
    for remark in ["# exported grain points: x y z", "# x y z", "# a sphere"] {
        let scan = parse(format!("{remark}\n{rows}").as_bytes()).unwrap();
        assert_eq!(scan.warnings, [""; 0], "{remark}");
    }
    assert_eq!(first("# Columns: t x y z\n7 1 2 3"), [1.0, 2.0, 3.0]);
}

#[test]
fn headings_tell_the_unit() {
    let unit = |text: &str| parse(text.as_bytes()).unwrap().unit;
    assert_eq!(unit("x_mm,y_mm,z_mm\n1,2,3"), Some("mm".into()));
    let micro = "# X [\u{b5}m] Y [\u{b5}m] Z [\u{b5}m]\n1 2 3";
    assert_eq!(unit(micro), Some("um".into()));
    assert_eq!(unit("x (in),y (in),z (in)\n1,2,3"), Some("inch".into()));
    assert_eq!(unit("x_px,y_px,z_px\n1,2,3"), None);
    for odd in ["1e-6 m", "0.1 mm", "km", "Mm", "m/s"] {
        let text = format!("x [{odd}],y [{odd}],z [{odd}]\n1,2,3");
        assert_eq!(unit(&text).as_deref(), Some(odd));
    }
    assert_eq!(unit("x (in image),y (in image),z (in image)\n1,2,3"), None);
    assert_eq!(unit("x,y,z\n1,2,3"), None);
    let told = parse(b"# a cut\nx_mm,y_mm,z_um\n1,2,3")
        .unwrap_err()
        .to_string();
    let expected =
        "line 2: the heading `x_mm,y_mm,z_um` tells x, y and z in several units (mm, um)";
    assert!(told.starts_with(expected), "{told}");
}

#[test]
fn rows_may_be_named_and_lack_values() {
    let named = "\"z\" \"y\" \"x\"\n\"a1\" 3 2 1";
    assert_eq!(first(named), [1.0, 2.0, 3.0]);
    let labelled = "name,x,y,z\n\"grain, a\",1,2,3";
    assert_eq!(first(labelled), [1.0, 2.0, 3.0]);
    let labelled = "name x y z\n\"grain a\" 1 2 3";
    assert_eq!(first(labelled), [1.0, 2.0, 3.0]);
    let scan = parse(b"x,y,z\n1,2,3\nNA,NA,NA\n,,\n;;\n4,5,6\n").unwrap();
    assert_eq!(scan.points.len(), 2);
    assert!(scan.warnings[0].starts_with("Dropped 1 row "));
}

#[test]
fn a_table_of_three_long_rows_is_transposed() {
    let row = "0.5 1.5 ".repeat(30);
    let told = parse(format!("{row}\n{row}\n{row}\n").as_bytes()).unwrap_err();
    assert!(told.to_string().contains("transpose"), "{told}");
}

#[test]
fn decimal_commas_are_refused() {
    for text in ["1,5;2,5;3,5", "1,5 2,5 3,5", "1,5\t2\t3"] {
        let error = parse(text.as_bytes()).unwrap_err();
        assert!(error.to_string().starts_with("line 1:"), "{text}: {error}");
    }
}

#[test]
fn a_count_is_no_point() {
    assert_eq!(parse(b"1\n1 2 3 9").unwrap().points.len(), 1);
    let scan = parse(b"5\n1 2 3 9").unwrap();
    assert!(scan.warnings[0].contains("counts 5"), "{:?}", scan.warnings);
}

#[test]
fn rows_that_are_not_finite_are_dropped_with_a_warning() {
    let scan = parse(b"1 2 3\nNaN NaN nan\n-1.#IND 0 1.#INF\n4 5 6").unwrap();
    assert_eq!(scan.points.len(), 2);
    assert!(
        scan.warnings[0].starts_with("Dropped 2 rows "),
        "{:?}",
        scan.warnings
    );
}

#[test]
fn uneven_rows_are_refused_with_their_line() {
    for text in ["1 2 3\n\n1 2", "1 2 3\n# remark\n1 2 3 4"] {
        let error = parse(text.as_bytes()).unwrap_err();
        assert!(error.to_string().starts_with("line 3:"), "{error}");
    }
}
