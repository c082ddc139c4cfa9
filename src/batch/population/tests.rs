use super::*;
use crate::batch::columns::columns;
use crate::report::Measure;

/// Two grains of these units, with an area, a sphericity and a held-out error.
fn two(units: [Option<&str>; 2]) -> Population {
    let columns = columns(&[Measure::Area, Measure::Sphericity]);
    let mut population = Population::new(&columns);
    for unit in units {
        population.add(&Row {
            unit: unit.map(str::to_owned),
            figures: [vec![Some(2.0), None], vec![Some(0.9); 12]].concat(),
            heldout_rms: Some(0.1),
            ..Row::default()
        });
    }
    population.finish(&[]);
    population
}

/// Of these areas the median is 7, and half of them are within 4.5 of it.
#[test]
fn deviations_are_from_the_mean_of_the_two_values_in_the_middle() {
    let mut population = Population::new(&columns(&[Measure::Area]));
    for area in [1.0, 2.0, 3.0, 4.0, 10.0, 11.0, 12.0, 60.0] {
        population.add(&Row {
            path: format!("{area}"),
            figures: vec![Some(area)],
            ..Row::default()
        });
    }
    population.finish(&[]);
    let [outlier] = population.outliers.as_slice() else {
        panic!("{:?}", population.outliers);
    };
    assert!(
        (outlier.z - 53.0 / (1.4826 * 4.5)).abs() < 1e-9,
        "{}",
        outlier.z
    );
}

#[test]
fn what_differs_from_values_that_are_all_alike_is_worth_a_look() {
    let mut population = Population::new(&columns(&[Measure::Area]));
    for (number, area) in [2.0, 2.0, 2.0, 2.0, 2.0, 2.0, 2.001, 5.0]
        .into_iter()
        .enumerate()
    {
        population.add(&Row {
            path: number.to_string(),
            figures: vec![Some(area)],
            ..Row::default()
        });
    }
    population.finish(&[]);
    let [outlier] = population.outliers.as_slice() else {
        panic!("{:?}", population.outliers);
    };
    assert_eq!(outlier.path, "7");
    let mean = 3.001 / 8.0;
    assert!((outlier.z - 3.0 / (1.253_314_137 * mean)).abs() < 1e-6);
}

#[test]
fn what_is_in_several_units_is_not_told_together_and_why() {
    let names = |found: &Population| -> Vec<String> {
        let measures = found.measures.iter();
        measures.map(|one| one.measure.clone()).collect()
    };
    let all = ["area", "sphericity.wadell", "heldout_rms"];
    let mixed = two([Some("mm"), Some("um")]);
    assert_eq!(names(&mixed), all[1..2]);
    assert_eq!(mixed.correlations.len(), 1);
    let [warning] = mixed.warnings.as_slice() else {
        panic!("{:?}", mixed.warnings);
    };
    assert!(warning.contains("in mm and um") && warning.contains("area, heldout_rms"));
    let partly = two([Some("mm"), None]);
    assert_eq!(names(&partly), all);
    assert!(partly.warnings[0].starts_with("No unit is told of 1 of 2 grains"));
    for unit in [None, Some("mm")] {
        let alike = two([unit; 2]);
        assert_eq!((names(&alike).len(), alike.warnings.len()), (3, 0));
    }
}

#[test]
fn a_population_has_the_statistics_worked_out_by_hand() {
    let columns = columns(&[Measure::Area, Measure::Volume]);
    let mut population = Population::new(&columns);
    let areas = [2.0, 4.0, 4.0, 5.0, 5.0, 6.0, 7.0, 9.0, 100.0];
    for (number, area) in areas.into_iter().enumerate() {
        // Area, its error, volume, its error.
        population.add(&Row {
            path: number.to_string(),
            figures: vec![Some(area), None, Some(-2.0 * area), None],
            ..Row::default()
        });
    }
    population.finish(&[]);
    let area = &population.measures[0];
    assert_eq!((area.measure.as_str(), area.count), ("area", 9));
    // The sum is 142; the quartiles are the 3rd and 7th of nine.
    assert!((area.mean - 142.0 / 9.0).abs() < 1e-12);
    assert_eq!(
        area.quantiles,
        [2.0, 2.8, 4.0, 5.0, 7.0, 63.6, 100.0].map(|x: f64| {
            area.quantiles
                .iter()
                .copied()
                .min_by(|a, b| (a - x).abs().total_cmp(&(b - x).abs()))
                .unwrap()
        })
    );
    assert!((area.quantiles[5] - 63.6).abs() < 1e-9 && (area.quantiles[1] - 2.8).abs() < 1e-9);
    assert!((population.correlations[0][1].unwrap() + 1.0).abs() < 1e-12);
    // Deviations from 5: 3 1 1 0 0 1 2 4 95, their median 1.
    let [outlier, volume] = population.outliers.as_slice() else {
        panic!("{:?}", population.outliers);
    };
    assert_eq!(
        (outlier.path.as_str(), volume.measure.as_str()),
        ("8", "volume")
    );
    assert!((outlier.z - 95.0 / 1.4826).abs() < 1e-9);
    // Held-out errors are known of no grain.
    assert_eq!(population.measures.len(), 2);
}

/// How many of eight grains are worth a look: one has an area so many millionths above 1, the others less than 7, all with
/// this standard error.
fn outliers_among_nearly_alike(far: i32, error: Option<f64>) -> usize {
    let mut population = Population::new(&columns(&[Measure::Area]));
    for (number, millionths) in [0, 1, 2, 3, 4, 5, 6, far].into_iter().enumerate() {
        population.add(&Row {
            path: number.to_string(),
            figures: vec![Some(1.0 + 1e-6 * f64::from(millionths)), error],
            ..Row::default()
        });
    }
    population.finish(&[]);
    population.outliers.len()
}

#[test]
fn what_differs_by_less_than_the_figures_are_known_is_not_worth_a_look() {
    assert_eq!(outliers_among_nearly_alike(2000, Some(1.8e-3)), 1);
    assert_eq!(outliers_among_nearly_alike(2000, Some(2.2e-3)), 0);
    assert_eq!(outliers_among_nearly_alike(-2000, Some(1.8e-3)), 1);
    assert_eq!(outliers_among_nearly_alike(2000, None), 1);
    // Less than 1e-4.
    assert_eq!(outliers_among_nearly_alike(90, None), 0);
}

#[test]
fn what_is_withheld_of_some_grains_and_who_has_warnings_is_told() {
    let mut population = Population::new(&columns(&[Measure::Area, Measure::Form]));
    for number in 0..5 {
        let is_whole = number < 3;
        let figure = is_whole.then_some(f64::from(number));
        let odd = if number == 1 {
            vec!["A tip is rounded.".into()]
        } else {
            vec![]
        };
        population.add(&Row {
            path: number.to_string(),
            figures: [vec![figure, None], vec![Some(1.0); 6]].concat(),
            not_measured: if is_whole {
                vec![]
            } else {
                vec!["area: a hole; scan it".into()]
            },
            warnings: odd,
            ..Row::default()
        });
    }
    population.finish(&[]);
    assert_eq!(
        population.warnings,
        [
            "Of 5 grains 2 lack area (a hole): means are of the rest, which may be unlike these.",
            "1 of 5 grains has warnings of its own, in the column warnings of results.csv.",
        ]
    );
}
