use super::*;

/// Of so many vertices functions are chosen by fewer, and fitted to all.
#[test]
fn dense_faces_are_fitted_as_well_as_others() {
    let errors = [30, 36].map(|resolution| {
        let dense = mesh(resolution, banana);
        let fit = fitted(&dense, &FitOptions::default());
        assert_relative_eq!(fit.fitted_to.points[2], dense.vertices[2], epsilon = 1e-12);
        assert!(fit.samples >= dense.vertices.len());
        assert!(fit.held_out.rms <= fit.limit, "{:?}", fit.held_out);
        let grain = PositionGrain::new(fit.frame, fit.surface).unwrap();
        grain_properties(&grain).properties.volume / BANANA_VOLUME - 1.0
    });
    assert!(errors.iter().all(|off| off.abs() < 2e-3), "{errors:?}");
}
