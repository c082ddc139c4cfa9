//! Scans of barley kernels, stones and a tuber.

/// Scans that are told one by one.
pub(crate) const SCANS: [&str; 12] = [
    "barley_batch/l1_30.ply",
    "barley_batch/l1_05.ply",
    "barley_batch/l2_10.ply",
    "barley_batch/l3_09.ply",
    "stone/low_res_AAA.ply",
    "stone/low_res_E22.ply",
    "lithic/ClarksonEXP02_Discoid.stl",
    "barley/barley_S017_l2_07_ascii.ply",
    "standins/maize_levallois_6146.xyz",
    "standins/barley_l1_01_6146.xyz",
    "standins/chickpea_danshaku_6146.xyz",
    "standins/bean_stoneE22_1538.xyz",
];
