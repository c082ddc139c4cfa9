//! Vectors and turns in files, as plain numbers that are read back to the last bit.

macro_rules! as_numbers {
    ($name:ident, $kind:ty, $count:literal, $to:expr, $from:expr) => {
        pub(super) mod $name {
            use serde::{Deserialize, Deserializer, Serialize, Serializer};

            pub(in crate::bed) fn serialize<S: Serializer>(
                value: &$kind,
                serializer: S,
            ) -> Result<S::Ok, S::Error> {
                let numbers: [f64; $count] = $to(value);
                numbers.serialize(serializer)
            }

            pub(in crate::bed) fn deserialize<'de, D: Deserializer<'de>>(
                deserializer: D,
            ) -> Result<$kind, D::Error> {
                <[f64; $count]>::deserialize(deserializer).map($from)
            }
        }
    };
}

as_numbers!(
    vector,
    nalgebra::Vector3<f64>,
    3,
    |v: &nalgebra::Vector3<f64>| (*v).into(),
    nalgebra::Vector3::from
);
as_numbers!(
    point,
    nalgebra::Point3<f64>,
    3,
    |p: &nalgebra::Point3<f64>| p.coords.into(),
    nalgebra::Point3::from
);
// w, x, y, z.
as_numbers!(
    turn,
    nalgebra::UnitQuaternion<f64>,
    4,
    |q: &nalgebra::UnitQuaternion<f64>| [q.w, q.i, q.j, q.k],
    |[w, x, y, z]| nalgebra::Unit::new_unchecked(nalgebra::Quaternion::new(w, x, y, z))
);
