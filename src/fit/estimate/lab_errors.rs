use super::errors::Best;
use super::figures::Figures;
use super::lab::*;
use super::*;
use crate::measure::{MassProperties, grain_properties, support_near};
use crate::model::{Frame, Grain, StarSurface, Surface, Whole};
use crate::shapes::{Body, Sampling};
use nalgebra::{Matrix3, Point3};
use std::time::Instant;

pub(crate) fn truth(p: &MassProperties, surface: &(impl StarSurface + ?Sized)) -> Figures {
    let pr = p.principal().unwrap();
    let starts = fibonacci(20000);
    Figures {
        area: p.area,
        volume: p.volume,
        centroid: p.centroid.coords,
        inertia: p.inertia,
        moments: pr.moments,
        dimensions: Vector3::from_fn(|i, _| {
            let a = pr.axes.column(i).into_owned();
            let far = |a: Vector3<f64>| {
                starts
                    .iter()
                    .map(|n| (n, surface.radius(n) * n.dot(&a)))
                    .max_by(|x, y| x.1.total_cmp(&y.1))
                    .map(|(n, _)| support_near(surface, &a, n).point.dot(&a))
                    .unwrap()
            };
            far(a) + far(-a)
        }),
    }
}
pub(crate) fn nist_truth(g: &Nist) -> Figures {
    let whole = Whole::new(g.c.clone()).unwrap();
    let frame = Frame {
        centre: Point3::origin(),
        axes: Matrix3::identity(),
    };
    let grain = Grain::new(frame, Surface::Whole(whole)).unwrap();
    truth(&grain_properties(&grain).properties, &grain)
}
#[derive(Default)]
pub(crate) struct Cover(pub Vec<[f64; 8]>);
impl Cover {
    pub(crate) fn print(&self, name: &str, seconds: f64) {
        let n = self.0.len();
        let mut line = format!("== {name:28} n {n:3}");
        for (i, what) in ["S", "V", "I1", "I2", "I3", "len", "wid", "thi"]
            .iter()
            .enumerate()
        {
            let mut z: Vec<f64> = self.0.iter().map(|z| z[i]).collect();
            let mean = z.iter().sum::<f64>() / n as f64;
            let rms = (z.iter().map(|z| z * z).sum::<f64>() / n as f64).sqrt();
            let cover = z.iter().filter(|z| z.abs() < 1.96).count() as f64 / n as f64;
            z.sort_by(|a, b| a.abs().total_cmp(&b.abs()));
            line += &format!(" | {what} {:.2} ({mean:+.2} {rms:.2})", cover);
        }
        println!(
            "{line} | {seconds:.3} s told {}",
            TOLD.swap(0, std::sync::atomic::Ordering::Relaxed)
        );
    }
}
pub(crate) fn zs(e: &Estimate, truth: &Figures) -> ([f64; 8], f64, StandardErrors) {
    let t = Instant::now();
    let best = Best::new(
        e,
        &super::posterior::Posterior::new(&e.cloud, e.degree, e.is_factored),
    )
    .unwrap();
    let f = best.figures;
    let se = best.errors(&f);
    let _ = t;
    let t = Instant::now();
    TOLD.fetch_add(
        e.errors(&f).is_err() as usize,
        std::sync::atomic::Ordering::Relaxed,
    );
    let t = t.elapsed().as_secs_f64();
    let mut z = [0.0; 8];
    z[0] = (f.area - truth.area) / se.area;
    z[1] = (f.volume - truth.volume) / se.volume;
    for i in 0..3 {
        z[2 + i] = (f.moments[i] - truth.moments[i]) / se.moments[i];
        z[5 + i] = (f.dimensions[i] - truth.dimensions[i]) / se.dimensions[i];
    }
    (z, t, se)
}
use super::errors::StandardErrors;

static TOLD: std::sync::atomic::AtomicUsize = std::sync::atomic::AtomicUsize::new(0);

pub(crate) fn thin(dirs: Vec<Vector3<f64>>, v: char) -> Vec<Vector3<f64>> {
    match v {
        't' => dirs
            .into_iter()
            .enumerate()
            .filter(|(i, n)| n.x < 0.0 || i % 8 == 0)
            .map(|x| x.1)
            .collect(),
        'h' => dirs
            .into_iter()
            .filter(|n| n.x < 20f64.to_radians().cos())
            .collect(),
        _ => dirs,
    }
}

#[test]
#[ignore]
fn coverage() {
    let variants = std::env::var("V").unwrap_or("abnceth".into());
    let every: usize = std::env::var("EVERY").map_or(1, |v| v.parse().unwrap());
    let verbose = std::env::var("VERB").is_ok();
    let all: Vec<(Nist, Figures)> = Nist::all()
        .into_iter()
        .step_by(every)
        .map(|g| {
            let t = nist_truth(&g);
            (g, t)
        })
        .collect();
    for v in variants.chars() {
        let (n, sd) = match v {
            'a' => (6146, 0.0),
            'b' | 't' | 'h' | 'T' => (6146, 0.005),
            'n' => (6146, 0.02),
            'c' => (1538, 0.0),
            _ => (1538, 0.005),
        };
        let mut cover = Cover::default();
        let mut seconds = 0.0;
        for (i, (g, truth)) in all.iter().enumerate() {
            let dirs = thin(fibonacci(n), if v == 'T' { 'a' } else { v });
            let p = prepare(noisy(&dirs, |n| g.radius(n), sd * g.mean, 7 + i as u64));
            let mut rows = p.samples().rows().to_vec();
            if v == 'T' {
                let mut k = 0;
                rows.retain(|r| {
                    r[0] < 0.0 || {
                        k += 1;
                        k % 8 == 0
                    }
                });
            }
            if std::env::var("CENTRE").is_ok() {
                println!(
                    "{v} {} centre {:.3} of mean {:.3} rows {}",
                    g.name,
                    p.frame().centre.coords.norm() / g.mean,
                    p.mean_radius / g.mean,
                    rows.len()
                );
            }
            let e = estimate(&rows, p.semi_axes);
            let (z, t, se) = zs(&e, truth);
            seconds += t;
            if verbose {
                println!(
                    "{v} {:28} L {} slope {:.1} {z:5.2?} SE% {:.4} {:.4} {:.4} t {t:.3}",
                    g.name,
                    e.degree,
                    e.spectrum.slope(),
                    100.0 * se.area / truth.area,
                    100.0 * se.volume / truth.volume,
                    100.0 * se.dimensions[0] / truth.dimensions[0]
                );
            }
            cover.0.push(z);
        }
        cover.print(&format!("nist {v}"), seconds / all.len() as f64);
    }
}

#[test]
#[ignore]
fn synth() {
    let seeds: u64 = std::env::var("SEEDS").map_or(10, |v| v.parse().unwrap());
    for body in [Body::Bean, Body::Chickpea, Body::Maize] {
        let s = body.surface();
        let truth = truth(&s.integrals().properties, s.as_ref());
        let mean = s.integrals().mean_radius;
        for (n, sd) in [(1538, 0.0), (1538, 0.005), (6146, 0.0), (6146, 0.005)] {
            let mut cover = Cover::default();
            let mut seconds = 0.0;
            for seed in 0..seeds {
                let dirs = match seed % 2 {
                    0 => Sampling::Cube.directions(n, 0).unwrap(),
                    _ => random(n, seed),
                };
                let p = prepare(noisy(&dirs, |n| s.radius(n), sd * mean, 7 + seed));
                let e = estimate(p.samples().rows(), p.semi_axes);
                let (z, t, _) = zs(&e, &truth);
                if std::env::var("VERB").is_ok() {
                    println!("{body} {z:6.2?}");
                }
                seconds += t;
                cover.0.push(z);
            }
            cover.print(&format!("{body} {n} {sd}"), seconds / seeds as f64);
        }
    }
}

#[test]
#[ignore]
fn hidden_cover() {
    use crate::scan::read_scan;
    use rand_chacha::ChaCha8Rng;
    use rand_chacha::rand_core::{Rng, SeedableRng};
    let which = std::env::var("S").unwrap_or_default();
    for name in SCANS.iter().filter(|s| s.contains(&which)) {
        let scan = read_scan(format!("../shared/scans/{name}").as_ref()).unwrap();
        let mut points = scan.points.clone();
        points.sort_by(|a, b| {
            a.x.total_cmp(&b.x)
                .then(a.y.total_cmp(&b.y))
                .then(a.z.total_cmp(&b.z))
        });
        points.dedup();
        let mut rng = ChaCha8Rng::seed_from_u64(3);
        let (mut train, mut test) = (vec![], vec![]);
        for p in points {
            if rng.next_u32() % 10 == 0 {
                test.push(p)
            } else {
                train.push(p)
            }
        }
        let p = prepare(train);
        let e = estimate(p.samples().rows(), p.semi_axes);
        let frame = *p.frame();
        let (dirs, r): (Vec<_>, Vec<_>) = test
            .iter()
            .map(|q| {
                let l = frame.to_local(q);
                (l.normalize(), l.norm())
            })
            .unzip();
        let fit = e.radii_at(&dirs);
        let t = Instant::now();
        let errors = e.radius_errors(&dirs);
        let t = t.elapsed().as_secs_f64();
        let z: Vec<f64> = fit
            .iter()
            .zip(&r)
            .zip(&errors)
            .map(|((a, b), e)| (a - b) / e.point)
            .collect();
        let share = |k: f64| z.iter().filter(|z| z.abs() < k).count() as f64 / z.len() as f64;
        println!(
            "{name:40} n {} L {} cover50 {:.3} cover95 {:.3} rms z {:.2} t {t:.2}",
            e.cloud.len(),
            e.degree,
            share(0.6745),
            share(1.96),
            (z.iter().map(|z| z * z).sum::<f64>() / z.len() as f64).sqrt()
        );
    }
}

/// Statistics of residuals over classes.
#[test]
#[ignore]
fn statistics() {
    use super::posterior::Posterior;
    use crate::scan::read_scan;
    let stat = |name: &str, e: &Estimate| {
        let residuals = Posterior::new(&e.cloud, e.degree, false).residuals(&e.coefficients);
        let (k, limit) = (
            super::unresolved::kurtosis(&residuals),
            super::unresolved::limit(residuals.len()),
        );
        println!(
            "kurt {name:34} n {} {k:.2} limit {limit:.2} {}",
            residuals.len(),
            if k > limit { "TOLD" } else { "" }
        );
    };
    let part = std::env::var("PART").unwrap_or("bns".into());
    if part.contains('b') {
        for body in [
            Body::Cube,
            Body::Cylinder,
            Body::Bicone,
            Body::Bean,
            Body::Chickpea,
            Body::Maize,
        ] {
            let s = body.surface();
            let mean = s.integrals().mean_radius;
            for n in [1538, 6146] {
                for sd in [0.0, 0.005] {
                    for layout in [0, 1, 2] {
                        let dirs = match layout {
                            0 => Sampling::Cube.directions(n, 0).unwrap(),
                            1 => fibonacci(n),
                            _ => random(n, 5),
                        };
                        let p = prepare(noisy(&dirs, |n| s.radius(n), sd * mean, 7 + layout));
                        stat(
                            &format!("{body} {n} {sd} {layout}"),
                            &estimate(p.samples().rows(), p.semi_axes),
                        );
                    }
                }
            }
        }
    }
    if part.contains('n') {
        for (i, g) in Nist::all().iter().enumerate().step_by(4) {
            for v in ['a', 'b', 'n', 'c', 'e', 't', 'h'] {
                let (n, sd) = match v {
                    'a' => (6146, 0.0),
                    'n' => (6146, 0.02),
                    'c' => (1538, 0.0),
                    'e' => (1538, 0.005),
                    _ => (6146, 0.005),
                };
                let dirs = thin(fibonacci(n), v);
                let p = prepare(noisy(&dirs, |n| g.radius(n), sd * g.mean, 7 + i as u64));
                stat(
                    &format!("{v} {}", g.name),
                    &estimate(p.samples().rows(), p.semi_axes),
                );
            }
        }
    }
    if part.contains('s') {
        for name in SCANS {
            let p = prepare(
                read_scan(format!("../shared/scans/{name}").as_ref())
                    .unwrap()
                    .points,
            );
            stat(name, &estimate(p.samples().rows(), p.semi_axes));
        }
    }
}

/// Kernels of 1538 points against the figures of their full meshes.
#[test]
#[ignore]
fn kernels() {
    use crate::scan::read_scan;
    let every: usize = std::env::var("EVERY").map_or(4, |v| v.parse().unwrap());
    let text = std::fs::read_to_string("../shared/scans/barley_batch/truth.csv").unwrap();
    let mut all = vec![];
    for line in text.lines().skip(1).step_by(every) {
        let f: Vec<&str> = line.split(',').collect();
        let number = |i: usize| f[i].parse::<f64>().unwrap();
        let scan = read_scan(format!("../shared/scans/barley_batch/{}", f[0]).as_ref()).unwrap();
        let p = prepare(scan.points);
        let e = estimate(p.samples().rows(), p.semi_axes);
        let best = Best::new(
            &e,
            &super::posterior::Posterior::new(&e.cloud, e.degree, e.is_factored),
        )
        .unwrap();
        let fig = best.figures;
        let se = best.errors(&fig);
        let (v, s) = (number(2), number(4));
        println!(
            "{:12} L {} noise {:.3} sd {:.3} V {:+.3}% SE {:.3} z {:+.2} | S {:+.3}% SE {:.3} z {:+.2} | len {:.2} {:.2} {:.2} z {:+.2} {:+.2} {:+.2}",
            f[0],
            e.degree,
            100.0 * e.spectrum.noise(),
            100.0 * e.sd(),
            100.0 * (fig.volume / v - 1.0),
            100.0 * se.volume / v,
            (fig.volume - v) / se.volume,
            100.0 * (fig.area / s - 1.0),
            100.0 * se.area / s,
            (fig.area - s) / se.area,
            fig.dimensions[0],
            fig.dimensions[1],
            fig.dimensions[2],
            (fig.dimensions[0] - number(9)) / se.dimensions[0],
            (fig.dimensions[1] - number(10)) / se.dimensions[1],
            (fig.dimensions[2] - number(11)) / se.dimensions[2]
        );
        all.push([(fig.volume - v) / se.volume, (fig.area - s) / se.area]);
    }
    for i in 0..2 {
        let n = all.len() as f64;
        println!(
            "== {} cover {:.2} rms {:.2}",
            ["V", "S"][i],
            all.iter().filter(|z| z[i].abs() < 1.96).count() as f64 / n,
            (all.iter().map(|z| z[i] * z[i]).sum::<f64>() / n).sqrt()
        );
    }
}

#[test]
#[ignore]
fn thinned() {
    use super::posterior::Posterior;
    let want = std::env::var("G").unwrap_or("ellipsoid-anm-00084".into());
    for (i, g) in Nist::all()
        .iter()
        .enumerate()
        .filter(|(_, g)| g.name.contains(&want))
    {
        let dirs = thin(fibonacci(6146), 't');
        println!("dirs {}", dirs.len());
        let p = prepare(noisy(&dirs, |n| g.radius(n), 0.005 * g.mean, 7 + i as u64));
        println!("samples {}", p.samples().rows().len());
        let e = estimate(p.samples().rows(), p.semi_axes);
        println!(
            "outliers {} L {} stretch {:?} spectrum {:?}",
            e.outliers, e.degree, e.cloud.stretch, e.spectrum
        );
        for dense in [false, true] {
            let post = Posterior::new(&e.cloud, e.degree, dense);
            let given = post.given(&e.spectrum);
            let (m, steps) = given.mean(None, 0.1);
            let (m2, steps2) = given.mean(None, 1e-6);
            let d: f64 = m
                .iter()
                .zip(&e.coefficients)
                .map(|(a, b)| (a - b).powi(2))
                .sum::<f64>()
                .sqrt();
            let d2: f64 = m2
                .iter()
                .zip(&e.coefficients)
                .map(|(a, b)| (a - b).powi(2))
                .sum::<f64>()
                .sqrt();
            let r = post.residuals(&m2);
            println!(
                "dense {dense} steps {steps} {steps2} diff from e {d:.5} {d2:.5} kurt {:.2} (e {:.2})",
                super::unresolved::kurtosis(&r),
                super::unresolved::kurtosis(&post.residuals(&e.coefficients))
            );
            if dense {
                let mut big: Vec<usize> = (0..r.len()).collect();
                big.sort_by(|&a, &b| r[b].abs().total_cmp(&r[a].abs()));
                for &i in big.iter().take(8) {
                    println!(
                        "   {:+.4} at {:.3?} r {:.3}",
                        r[i],
                        e.cloud.directions[i].as_slice(),
                        e.cloud.radii[i]
                    );
                }
            }
        }
    }
}
