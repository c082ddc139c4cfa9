//! The arguments of `grainform synth`.

use crate::cli::numbers::{count, exponents, share, vector};
use crate::cli::values::{CloudFormat, SemiAxes, Subject};
use crate::shapes::Sampling;
use clap::Args;
use nalgebra::Vector3;
use std::path::PathBuf;

/// Make a synthetic scan of a body whose area, volume and inertia are known, or of a tray of grains
#[derive(Args)]
pub(in crate::cli) struct SynthArgs {
    /// bean, chickpea or maize; a shape: sphere, ellipsoid, cylinder, bicone, octahedron, cuboid or cube; a
    /// superquadric, or poly, whose octants differ with six --axes; what no centre sees whole: banana, cup, mushroom,
    /// hook or random, another one for every seed, as a mesh or, with --points, as points; or tray: grains on a plane,
    /// one in ten touching another, with dust
    pub(in crate::cli) body: Subject,

    /// Number of grains on a tray [default: 100]
    #[arg(long, value_name = "N", value_parser = count::<usize>)]
    pub(in crate::cli) grains: Option<usize>,

    /// Of a tray, write here what each point was taken from, a line each: plane, dust or the number of a grain
    #[arg(long, value_name = "FILE.txt")]
    pub(in crate::cli) labels: Option<PathBuf>,

    /// Semi-axes of a shape, or half its extents, in x, y and z; six of a poly, on the positive and on the negative
    /// side of each [default: the shape's own]
    #[arg(long, value_name = "A,B,C")]
    pub(in crate::cli) axes: Option<SemiAxes>,

    /// Exponents of a superquadric or a poly: n1 of z, n2 of x and y [default: 4,2]
    #[arg(long, value_name = "N1,N2", value_parser = exponents)]
    pub(in crate::cli) exponents: Option<[f64; 2]>,

    /// Number of points; met as nearly as the sampling can [default: the body's own]
    #[arg(long, value_name = "N", value_parser = count::<usize>)]
    pub(in crate::cli) points: Option<usize>,

    /// Layout of the directions: cube, fibonacci, rings or random [default: cube]
    #[arg(long)]
    pub(in crate::cli) sampling: Option<Sampling>,

    /// Standard deviation of the radial noise, as a share of the mean radius: 0.5% or 0.005
    #[arg(long, value_name = "S", default_value = "0", value_parser = share)]
    pub(in crate::cli) noise: f64,

    /// Share of the points that lie 20 % too far in or out: 1% or 0.01
    #[arg(long, value_name = "S", default_value = "0", value_parser = share)]
    pub(in crate::cli) outliers: f64,

    /// Half-opening angle, in degrees, of a cap around -z that was not seen
    #[arg(long, value_name = "DEG", default_value_t = 0.0)]
    pub(in crate::cli) missing_cap: f64,

    /// Where the body's origin lies
    #[arg(long, value_name = "X,Y,Z", default_value = "0,0,0", value_parser = vector)]
    pub(in crate::cli) offset: Vector3<f64>,

    /// Seed of everything random
    #[arg(long, value_name = "K", value_parser = count::<u64>, default_value_t = 0)]
    pub(in crate::cli) seed: u64,

    /// Write the points here: .ply or .xyz (- for standard output); a banana, cup, mushroom, hook or random is a mesh,
    /// .stl, .ply, .obj, .vtp or .glb, unless --points asks for points
    #[arg(short, long, value_name = "FILE")]
    pub(in crate::cli) output: Option<PathBuf>,

    /// Format of the points on standard output: ply or xyz [default: ply]
    #[arg(long, value_name = "FORMAT")]
    pub(in crate::cli) format: Option<CloudFormat>,

    /// Print one JSON object
    #[arg(long)]
    pub(in crate::cli) json: bool,
}
