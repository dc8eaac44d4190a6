//! The two figures as tables of sections, drawn on their reference bodies (EU 38, EU 50).
//!
//! Every number is a length in metres on the reference body, unless it says otherwise. The form
//! stretches the tables in height to the stations of a body and in girth until its tapes agree.

use crate::garment::scene::Figure;

/// Heights between which the trunk's table is stretched, from below: crotch, hip, waist,
/// underbust, bust, underarm, acromion, side of the neck.
pub(super) const STATIONS: usize = 8;

/// A section of the trunk: station (7 = side of the neck; below the first and above the last, in
/// tenths of a metre on), half breadth, reach to the front and
/// to the back of its middle, place of the middle in front of the ankles, fullness between
/// the axes.
pub(super) type TrunkRow = [f64; 6];

/// A section of a limb: share of the way along it, reach to +u, −u, +v, −v, middle along u and v.
pub(super) type LimbRow = [f64; 7];

/// A rounded swelling: middle (to the side, up from its station, to the front), radii in the same
/// order. `up` tells the radius above the middle from that below it.
#[derive(Clone, Copy, Debug)]
pub(super) struct Swelling {
    /// Station of the middle.
    pub(super) station: usize,
    /// Middle, from the middle plane, the station and the ankles.
    pub(super) middle: [f64; 3],
    /// Radii to the side, downwards, to the front.
    pub(super) radii: [f64; 3],
    /// Radius upwards.
    pub(super) up: f64,
    /// How far the fillet to the trunk reaches.
    pub(super) blend: f64,
}

/// All tables of a figure.
#[derive(Debug)]
pub(super) struct Template {
    /// Height of the reference body.
    pub(super) height: f64,
    /// Sections of the trunk.
    pub(super) trunk: &'static [TrunkRow],
    /// Sections of the leg from the sole (0) to the crotch (1) and beyond; u to the side.
    pub(super) leg: &'static [LimbRow],
    /// Sections of the arm from the shoulder joint (0) to the wrist (1); u to the front, v
    /// upwards and outwards.
    pub(super) arm: &'static [LimbRow],
    /// Sections of the hand from the wrist (0) to the finger tips (1).
    pub(super) hand: &'static [LimbRow],
    /// Sections of the neck from its root (0) into the head (1); u to the side, v to the front.
    pub(super) neck: &'static [LimbRow],
    /// Chest: breasts or the great chest muscles.
    pub(super) chest: Swelling,
    /// Buttocks.
    pub(super) seat: Swelling,
    /// Fall of the shoulder line, rad.
    pub(super) slope: f64,
    /// Lean of the neck to the front, rad.
    pub(super) lean: f64,
    /// Girths on which the tables are drawn, by measure.
    pub(super) girths: &'static [(&'static str, f64)],
}

impl Template {
    /// The trunk's section at the acromion.
    pub(super) fn shoulder(&self) -> TrunkRow {
        self.trunk.iter().copied().find(|row| row[0] >= 6.0).unwrap_or_default()
    }
}

/// The tables of a figure.
pub(super) fn template(figure: Figure) -> &'static Template {
    match figure {
        Figure::Female => &FEMALE,
        Figure::Male => &MALE,
    }
}

const FEMALE: Template = Template {
    height: 1.68,
    trunk: &[
        [-0.6, 0.088, 0.064, 0.066, -0.004, 0.000],
        [-0.1, 0.092, 0.066, 0.068, -0.004, 0.000],
        [0.4, 0.120, 0.077, 0.080, -0.004, 0.000],
        [0.7, 0.145, 0.083, 0.088, -0.005, 0.008],
        [1.0, 0.176, 0.095, 0.100, -0.006, 0.018],
        [1.4, 0.164, 0.098, 0.093, -0.003, 0.018],
        [1.7, 0.138, 0.095, 0.083, 0.001, 0.018],
        [2.0, 0.119, 0.088, 0.080, 0.004, 0.018],
        [3.0, 0.127, 0.081, 0.090, 0.003, 0.024],
        [4.0, 0.127, 0.073, 0.098, -0.003, 0.030],
        [5.0, 0.137, 0.069, 0.103, -0.010, 0.036],
        [5.5, 0.151, 0.060, 0.094, -0.018, 0.036],
        [6.0, 0.152, 0.045, 0.068, -0.028, 0.020],
        [6.5, 0.106, 0.038, 0.046, -0.032, 0.000],
        [7.0, 0.046, 0.022, 0.020, -0.026, 0.000],
        [7.3, 0.038, 0.016, 0.016, -0.022, 0.000],
    ],
    leg: &[
        [0.0, 0.032, 0.032, 0.036, 0.036, 0.094, -0.012],
        [0.06, 0.031, 0.031, 0.037, 0.037, 0.094, -0.012],
        [0.13, 0.030, 0.030, 0.036, 0.038, 0.093, -0.012],
        [0.21, 0.036, 0.035, 0.039, 0.043, 0.092, -0.012],
        [0.31, 0.048, 0.046, 0.045, 0.060, 0.092, -0.010],
        [0.43, 0.054, 0.052, 0.050, 0.066, 0.092, -0.006],
        [0.52, 0.051, 0.050, 0.053, 0.058, 0.091, 0.000],
        [0.60, 0.053, 0.055, 0.063, 0.055, 0.091, 0.005],
        [0.68, 0.058, 0.058, 0.068, 0.060, 0.092, 0.006],
        [0.80, 0.070, 0.069, 0.078, 0.073, 0.095, 0.005],
        [0.93, 0.081, 0.078, 0.088, 0.088, 0.094, 0.002],
        [1.00, 0.081, 0.077, 0.088, 0.092, 0.093, 0.000],
        [1.08, 0.076, 0.065, 0.080, 0.086, 0.091, 0.000],
        [1.20, 0.050, 0.045, 0.052, 0.058, 0.087, 0.000],
    ],
    arm: &[
        [0.0, 0.046, 0.046, 0.045, 0.045, 0.0, 0.0],
        [0.10, 0.049, 0.049, 0.048, 0.047, 0.0, 0.0],
        [0.20, 0.048, 0.048, 0.046, 0.046, 0.0, 0.0],
        [0.32, 0.046, 0.045, 0.042, 0.044, 0.0, 0.0],
        [0.45, 0.042, 0.041, 0.038, 0.040, 0.0, 0.0],
        [0.56, 0.038, 0.040, 0.037, 0.036, 0.002, 0.0],
        [0.66, 0.040, 0.040, 0.038, 0.037, 0.008, 0.0],
        [0.80, 0.034, 0.034, 0.031, 0.030, 0.018, 0.0],
        [0.93, 0.028, 0.028, 0.022, 0.022, 0.028, 0.0],
        [1.0, 0.0275, 0.0275, 0.020, 0.020, 0.033, 0.0],
    ],
    hand: &[
        [0.16, 0.029, 0.029, 0.018, 0.018, 0.040, 0.0],
        [0.36, 0.036, 0.036, 0.017, 0.018, 0.050, 0.0],
        [0.52, 0.037, 0.037, 0.016, 0.017, 0.057, 0.0],
        [0.76, 0.032, 0.033, 0.014, 0.015, 0.066, -0.003],
        [0.88, 0.026, 0.027, 0.013, 0.014, 0.070, -0.006],
    ],
    neck: &[
        [0.0, 0.060, 0.060, 0.058, 0.058, 0.0, 0.0],
        [0.35, 0.057, 0.057, 0.056, 0.056, 0.0, 0.0],
        [0.6, 0.051, 0.051, 0.053, 0.053, 0.0, 0.0],
        [1.0, 0.048, 0.048, 0.052, 0.052, 0.0, 0.0],
    ],
    chest: Swelling {
        station: 4,
        middle: [0.0, 0.003, -0.034],
        radii: [0.067, 0.065, 0.068],
        up: 0.112,
        blend: 0.075,
    },
    seat: Swelling {
        station: 1,
        middle: [0.074, -0.012, -0.056],
        radii: [0.082, 0.085, 0.076],
        up: 0.120,
        blend: 0.05,
    },
    slope: 0.36,
    lean: 0.29,
    girths: &[
        ("bust", 0.88),
        ("underbust", 0.75),
        ("waist", 0.72),
        ("hip", 0.97),
        ("neck", 0.36),
        ("thigh", 0.5626),
        ("knee", 0.3735),
        ("calf", 0.361),
        ("ankle", 0.223),
        ("upper_arm", 0.28),
        ("elbow", 0.2436),
        ("wrist", 0.158),
        ("head", 0.5544),
    ],
};

const MALE: Template = Template {
    height: 1.8,
    trunk: &[
        [-0.6, 0.088, 0.064, 0.066, -0.003, 0.000],
        [-0.1, 0.092, 0.066, 0.068, -0.003, 0.000],
        [0.4, 0.120, 0.077, 0.080, -0.003, 0.000],
        [0.7, 0.138, 0.090, 0.092, -0.004, 0.010],
        [1.0, 0.161, 0.102, 0.104, -0.004, 0.024],
        [1.4, 0.157, 0.104, 0.098, 0.000, 0.030],
        [1.7, 0.150, 0.106, 0.092, 0.003, 0.030],
        [2.0, 0.146, 0.108, 0.092, 0.004, 0.030],
        [3.0, 0.159, 0.107, 0.105, 0.000, 0.034],
        [4.0, 0.173, 0.108, 0.120, -0.008, 0.038],
        [5.0, 0.181, 0.102, 0.122, -0.012, 0.038],
        [5.5, 0.187, 0.086, 0.110, -0.021, 0.038],
        [6.0, 0.184, 0.053, 0.078, -0.032, 0.020],
        [6.5, 0.128, 0.044, 0.054, -0.036, 0.000],
        [7.0, 0.053, 0.026, 0.024, -0.030, 0.000],
        [7.3, 0.044, 0.020, 0.020, -0.026, 0.000],
    ],
    leg: &[
        [0.0, 0.036, 0.036, 0.040, 0.040, 0.102, -0.014],
        [0.06, 0.035, 0.035, 0.041, 0.041, 0.102, -0.014],
        [0.13, 0.033, 0.033, 0.039, 0.041, 0.101, -0.014],
        [0.21, 0.039, 0.038, 0.041, 0.046, 0.100, -0.014],
        [0.31, 0.051, 0.049, 0.046, 0.063, 0.099, -0.012],
        [0.43, 0.057, 0.055, 0.052, 0.070, 0.098, -0.008],
        [0.52, 0.054, 0.053, 0.056, 0.061, 0.097, 0.000],
        [0.60, 0.056, 0.057, 0.067, 0.058, 0.096, 0.005],
        [0.68, 0.061, 0.060, 0.072, 0.063, 0.096, 0.007],
        [0.80, 0.073, 0.070, 0.083, 0.077, 0.097, 0.007],
        [0.93, 0.083, 0.078, 0.091, 0.090, 0.095, 0.004],
        [1.00, 0.082, 0.077, 0.090, 0.093, 0.094, 0.002],
        [1.08, 0.076, 0.065, 0.080, 0.086, 0.091, 0.000],
        [1.20, 0.050, 0.045, 0.052, 0.058, 0.087, 0.000],
    ],
    arm: &[
        [0.0, 0.053, 0.053, 0.050, 0.050, 0.0, 0.0],
        [0.10, 0.058, 0.057, 0.056, 0.053, 0.0, 0.0],
        [0.20, 0.056, 0.055, 0.055, 0.051, 0.0, 0.0],
        [0.32, 0.053, 0.051, 0.048, 0.048, 0.0, 0.0],
        [0.45, 0.048, 0.047, 0.043, 0.045, 0.0, 0.0],
        [0.56, 0.043, 0.044, 0.042, 0.040, 0.002, 0.0],
        [0.66, 0.046, 0.046, 0.044, 0.042, 0.008, 0.0],
        [0.80, 0.040, 0.040, 0.036, 0.035, 0.018, 0.0],
        [0.93, 0.032, 0.032, 0.025, 0.025, 0.030, 0.0],
        [1.0, 0.031, 0.031, 0.023, 0.023, 0.035, 0.0],
    ],
    hand: &[
        [0.16, 0.033, 0.033, 0.021, 0.021, 0.043, 0.0],
        [0.36, 0.042, 0.042, 0.020, 0.021, 0.054, 0.0],
        [0.52, 0.043, 0.043, 0.018, 0.020, 0.062, 0.0],
        [0.76, 0.037, 0.038, 0.016, 0.017, 0.072, -0.003],
        [0.88, 0.030, 0.031, 0.015, 0.016, 0.077, -0.006],
    ],
    neck: &[
        [0.0, 0.068, 0.068, 0.066, 0.066, 0.0, 0.0],
        [0.35, 0.064, 0.064, 0.063, 0.063, 0.0, 0.0],
        [0.6, 0.060, 0.060, 0.061, 0.061, 0.0, 0.0],
        [1.0, 0.057, 0.057, 0.060, 0.060, 0.0, 0.0],
    ],
    chest: Swelling {
        station: 4,
        middle: [0.082, 0.028, -0.056],
        radii: [0.090, 0.050, 0.050],
        up: 0.090,
        blend: 0.06,
    },
    seat: Swelling {
        station: 1,
        middle: [0.074, -0.010, -0.050],
        radii: [0.078, 0.085, 0.072],
        up: 0.105,
        blend: 0.05,
    },
    slope: 0.36,
    lean: 0.31,
    girths: &[
        ("chest", 1.0),
        ("waist", 0.88),
        ("hip", 1.03),
        ("neck", 0.4),
        ("thigh", 0.5768),
        ("knee", 0.3863),
        ("calf", 0.376),
        ("ankle", 0.2318),
        ("upper_arm", 0.31),
        ("elbow", 0.2728),
        ("wrist", 0.175),
        ("head", 0.573),
    ],
};

/// A foot of a body 1.68 m tall: way from the ankle to the front, half breadth, height of the
/// top, middle to the side.
pub(super) const FOOT: &[[f64; 4]] = &[
    [-0.030, 0.030, 0.070, 0.000],
    [0.000, 0.033, 0.080, 0.000],
    [0.040, 0.036, 0.072, 0.002],
    [0.080, 0.042, 0.052, 0.005],
    [0.120, 0.046, 0.036, 0.006],
    [0.150, 0.044, 0.027, 0.004],
];
