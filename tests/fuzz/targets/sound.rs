//! What must hold of every scan that was read.

use grainform::scan::parse_scan;

pub fn parse(bytes: &[u8], extension: &str) {
    let Ok(scan) = parse_scan(bytes, Some(extension)) else {
        return;
    };
    assert!(scan.points.iter().flat_map(|point| point.iter()).all(|c| c.is_finite()));
    let corners = scan.triangles.as_flattened();
    assert!(corners.iter().all(|&corner| (corner as usize) < scan.points.len()));
    assert_eq!(scan.topology.is_none(), scan.triangles.is_empty());
    if let Some(topology) = &scan.topology {
        assert!(topology.bodies > 0 && topology.volume.is_finite());
    }
}
