use super::*;
use crate::fit::{PreparedScan, prepare::CellGrid};
use crate::scan::{Scan, read_scan};
use crate::sphere::{HarmonicBasis, harmonic_index};
use nalgebra::Point3;
use rand_chacha::ChaCha8Rng;
use rand_chacha::rand_core::{Rng, SeedableRng};
use rand_distr::{Distribution, StandardNormal};
use std::time::Instant;

pub(crate) struct Nist {
    pub(crate) name: String,
    pub(crate) basis: HarmonicBasis,
    pub(crate) c: Vec<f64>,
    pub(crate) mean: f64,
    pub(crate) volume: f64,
    pub(crate) area: f64,
}
impl Nist {
    pub(crate) fn all() -> Vec<Self> {
        let dir = "../shared/scans/nist_train/";
        let text = std::fs::read_to_string(format!("{dir}truth.csv")).unwrap();
        text.lines()
            .skip(1)
            .map(|line| {
                let f: Vec<&str> = line.split(',').collect();
                let degree: usize = f[2].parse().unwrap();
                let mut c = vec![0.0; coefficient_count(degree)];
                for line in std::fs::read_to_string(format!("{dir}{}", f[0]))
                    .unwrap()
                    .lines()
                {
                    let p: Vec<f64> = line
                        .replace(',', " ")
                        .split_whitespace()
                        .map(|x| x.parse().unwrap())
                        .collect();
                    if p.len() < 4 {
                        continue;
                    }
                    let (n, m) = (p[0] as usize, p[1] as isize);
                    if n > degree || m < 0 {
                        continue;
                    }
                    let sign = if m % 2 == 0 { 1.0 } else { -1.0 };
                    if m == 0 {
                        c[harmonic_index(n, 0)] = p[2];
                    } else {
                        c[harmonic_index(n, m)] = 2f64.sqrt() * sign * p[2];
                        c[harmonic_index(n, -m)] = -2f64.sqrt() * sign * p[3];
                    }
                }
                Nist {
                    name: f[0].into(),
                    basis: HarmonicBasis::new(degree),
                    c,
                    mean: f[6].parse().unwrap(),
                    volume: f[3].parse().unwrap(),
                    area: f[4].parse().unwrap(),
                }
            })
            .collect()
    }
    pub(crate) fn radius(&self, n: &Vector3<f64>) -> f64 {
        let mut v = vec![0.0; self.c.len()];
        self.basis.evaluate(n, &mut v);
        v.iter().zip(&self.c).map(|(a, b)| a * b).sum()
    }
}
pub(crate) fn fibonacci(n: usize) -> Vec<Vector3<f64>> {
    let g = std::f64::consts::PI * (3.0 - 5f64.sqrt());
    (0..n)
        .map(|i| {
            let z = 1.0 - 2.0 * (i as f64 + 0.5) / n as f64;
            let s = (1.0 - z * z).sqrt();
            let a = g * i as f64;
            Vector3::new(s * a.cos(), s * a.sin(), z)
        })
        .collect()
}
pub(crate) fn random(n: usize, seed: u64) -> Vec<Vector3<f64>> {
    let mut rng = ChaCha8Rng::seed_from_u64(seed);
    (0..n)
        .map(|_| {
            let v: Vector3<f64> = Vector3::from_fn(|_, _| StandardNormal.sample(&mut rng));
            v.normalize()
        })
        .collect()
}
pub(crate) fn noisy(
    dirs: &[Vector3<f64>],
    r: impl Fn(&Vector3<f64>) -> f64,
    sd: f64,
    seed: u64,
) -> Vec<Point3<f64>> {
    let mut rng = ChaCha8Rng::seed_from_u64(seed);
    dirs.iter()
        .map(|n| {
            let e: f64 = StandardNormal.sample(&mut rng);
            Point3::from(n * (r(n) + sd * e))
        })
        .collect()
}

impl Estimate {
    /// points on the surface, scan frame, for own-frame directions
    pub(crate) fn radii_at(&self, dirs: &[Vector3<f64>]) -> Vec<f64> {
        let (d, l): (Vec<_>, Vec<_>) = dirs
            .iter()
            .map(|n| {
                let m = self.cloud.stretch.component_mul(n);
                (m.normalize(), m.norm())
            })
            .unzip();
        let mut r = vec![0.0; d.len()];
        ScatteredHarmonics::new(self.degree, &d).synthesis(&self.coefficients, &mut r);
        r.iter()
            .zip(l)
            .map(|(r, l): (&f64, f64)| r * self.cloud.mean / l)
            .collect()
    }
    pub(crate) fn sd(&self) -> f64 {
        variance(&self.spectrum, &self.unlearnt).sqrt()
    }
}
fn quantiles(mut v: Vec<f64>) -> String {
    v.sort_by(f64::total_cmp);
    let q = |p: f64| v[((v.len() - 1) as f64 * p).round() as usize];
    format!("median {:.4} 90% {:.4} max {:.4}", q(0.5), q(0.9), q(1.0))
}

#[test]
#[ignore]
fn nist() {
    let variants = std::env::var("V").unwrap_or("abc".into());
    let every: usize = std::env::var("EVERY").map_or(5, |v| v.parse().unwrap());
    let judge = fibonacci(2000);
    for v in variants.chars() {
        let (mut rmss, mut noises) = (vec![], vec![]);
        let t0 = Instant::now();
        for (i, g) in Nist::all().iter().enumerate().step_by(every) {
            let n = match v {
                'c' | 'r' => 1538,
                'd' => 100_000,
                _ => 6146,
            };
            let sd = match v {
                'b' => 0.005,
                'n' => 0.02,
                _ => 0.0,
            };
            let dirs = if v == 'r' {
                random(n, i as u64)
            } else {
                fibonacci(n)
            };
            let p = prepare(noisy(&dirs, |n| g.radius(n), sd * g.mean, i as u64));
            let t = Instant::now();
            let e = estimate(p.samples().rows(), p.semi_axes);
            let t = t.elapsed().as_secs_f64();
            let frame = *p.frame();
            let radii = e.radii_at(&judge);
            let sq: f64 = judge
                .iter()
                .zip(&radii)
                .map(|(n, r)| {
                    let x = frame.to_scan(&(n * *r)).coords;
                    (x.norm() - g.radius(&x.normalize())).powi(2)
                })
                .sum();
            let rms = 100.0 * (sq / judge.len() as f64).sqrt() / g.mean;
            let told = 100.0 * e.spectrum.noise();
            println!(
                "{v} {:28} n {} L {} stretch {:.2} {:.2} rms {rms:.4} sd {:.4} noise {told:.4} slope {:.2} t {t:.3}",
                g.name,
                e.cloud.len(),
                e.degree,
                e.cloud.stretch.x,
                e.cloud.stretch.z,
                100.0 * e.sd(),
                e.spectrum.slope()
            );
            rmss.push(rms);
            noises.push(told);
        }
        println!(
            "== {v} rms {} | noise {} | {:.1} s",
            quantiles(rmss),
            quantiles(noises),
            t0.elapsed().as_secs_f64()
        );
    }
}

pub(crate) const SCANS: [&str; 14] = [
    "barley_batch/l1_30.ply",
    "barley_batch/l1_05.ply",
    "barley_batch/l2_10.ply",
    "barley_batch/l3_09.ply",
    "stone/low_res_AAA.ply",
    "standins/bean_stoneE22_1538.xyz",
    "stone/low_res_E22.ply",
    "lithic/ClarksonEXP02_Discoid.stl",
    "barley/barley_S017_l2_07_ascii.ply",
    "standins/maize_levallois_6146.xyz",
    "standins/barley_l1_01_6146.xyz",
    "standins/chickpea_danshaku_6146.xyz",
    "barley_batch/l2_02.ply",
    "barley_batch/l1_14.ply",
];

#[test]
#[ignore]
fn hidden() {
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
        let t = Instant::now();
        let e = estimate(p.samples().rows(), p.semi_axes);
        let t = t.elapsed().as_secs_f64();
        let frame = *p.frame();
        let (dirs, r): (Vec<_>, Vec<_>) = test
            .iter()
            .map(|q| {
                let l = frame.to_local(q);
                (l.normalize(), l.norm())
            })
            .unzip();
        let fit = e.radii_at(&dirs);
        let sq: f64 = fit
            .iter()
            .zip(&r)
            .map(|(a, b): (&f64, &f64)| (a - b).powi(2))
            .sum();
        println!(
            "{name:40} n {} L {} k {:.2} {:.2} hidden {:.3} sd {:.3} noise {:.3} slope {:.2} out {} t {t:.2}",
            e.cloud.len(),
            e.degree,
            e.cloud.stretch.x,
            e.cloud.stretch.z,
            100.0 * (sq / r.len() as f64).sqrt() / p.mean_radius,
            100.0 * e.sd(),
            100.0 * e.spectrum.noise(),
            e.spectrum.slope(),
            e.outliers
        );
    }
}
