//! What is known of the motion from another program, which solved the equations of the steps of `eem-temperature`.

use super::scene::STEP;
use eem_studies::claims::Claims;
use eem_studies::record::Record;
use eem_studies::statistics::TIME_TOLERANCE;

/// The scheme and, relative to the values, what they are good to.
const SCHEME: &str = "eem-temperature";
const ACCURACY: f64 = 1e-9;

/// Time (s), energy (J), kinetic energy (J), entropy (J/K).
const STATES: [[f64; 4]; 6] = [
    [0.5, -10_677.132_147_581, 88.517_067_628, -43.321_127_957_0],
    [1.0, -9_577.137_783_224, 937.614_717_884, -43.090_834_554_1],
    [
        2.0,
        -7_295.469_098_454,
        2_965.513_198_009,
        -42.681_224_389_4,
    ],
    [
        5.0,
        -7_295.469_098_454,
        3_084.852_082_220,
        -41.742_869_229_3,
    ],
    [
        10.0,
        -7_295.469_098_454,
        3_383.324_619_580,
        -40.771_437_792_4,
    ],
    [
        15.0,
        -7_295.469_098_454,
        3_236.542_651_835,
        -40.178_882_602_2,
    ],
];

/// The known states, as far as the run gets, when it has the scheme and the step.
pub(crate) fn check(run: &Record, step: f64, claims: &mut Claims) {
    if run.scheme != SCHEME || (step - STEP).abs() > TIME_TOLERANCE {
        return;
    }
    for [time, known @ ..] in STATES {
        let is_it = |own: &f64| (own - time).abs() <= TIME_TOLERANCE;
        let Some(row) = run.times().iter().position(is_it) else {
            continue;
        };
        for (name, known) in ["energy", "kinetic", "entropy"].into_iter().zip(known) {
            let found = run.column(name).map(|values| values[row]);
            claims.at_most(
                &format!("{SCHEME}, t = {time} s: the relative error of the {name}"),
                found.map(|found| (found / known - 1.0).abs()),
                ACCURACY,
            );
        }
    }
}
