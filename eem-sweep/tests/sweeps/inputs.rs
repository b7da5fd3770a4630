//! Inputs are the same in every process, and what makes no sense is refused.

use std::fs;

use eem::sweep::{InputError, Inputs, Selection};

use crate::program::directory;

fn values(inputs: &Inputs) -> Vec<f64> {
    let mut row = Vec::new();
    let members = 0..inputs.members();
    members
        .flat_map(|place| inputs.row(place, &mut row).values().to_vec())
        .collect()
}

#[test]
fn a_latin_hypercube_has_one_member_per_layer_and_depends_on_its_seed_alone() {
    let draw = |seed| {
        let ranges = [("a", 0.0..1.0), ("b", -5.0..5.0), ("c", 1e3..2e3)];
        Inputs::latin_hypercube(1000, seed, ranges).unwrap()
    };
    let drawn = values(&draw(1));
    assert_eq!(drawn, values(&draw(1)));
    assert_ne!(drawn, values(&draw(2)));
    for (column, (low, width)) in [(0.0, 1.0), (-5.0, 10.0), (1e3, 1e3)]
        .into_iter()
        .enumerate()
    {
        let column: Vec<f64> = drawn.iter().skip(column).step_by(3).copied().collect();
        let mut layers: Vec<f64> = column
            .iter()
            .map(|value| ((value - low) / width * 1000.0).floor())
            .collect();
        // Members do not come in the order of their layers.
        assert!(layers.windows(2).filter(|pair| pair[0] > pair[1]).count() > 400);
        layers.sort_by(f64::total_cmp);
        let near = layers
            .iter()
            .zip(0..)
            .all(|(layer, place)| (layer - f64::from(place)).abs() <= 1.0);
        assert!(near, "{layers:?}");
        // The error of the mean is that of the places within layers, 1/√12 of a layer over √1000 members.
        let mean = column.iter().sum::<f64>() / 1000.0;
        assert!((mean - low - 0.5 * width).abs() < 1e-4 * width, "{mean}");
    }
    // The first member of this seed on every machine.
    let bits: Vec<u64> = drawn[..3].iter().map(|value| value.to_bits()).collect();
    assert_eq!(bits, FIRST);
}

const FIRST: [u64; 3] = [
    4_606_399_004_531_264_635,
    13_819_157_010_960_698_336,
    4_655_271_617_968_497_206,
];

#[test]
fn files_are_read_with_and_without_ids() {
    let folder = directory("inputs");
    fs::create_dir_all(&folder).unwrap();
    let write = |text: &str| {
        let path = folder.join("inputs.csv");
        fs::write(&path, text).unwrap();
        Inputs::csv(path)
    };
    let plain = write("a,\"b, c\"\n1, 2\n 3e-1,inf\n").unwrap();
    assert_eq!(plain.columns(), ["a", "b, c"]);
    assert_eq!(values(&plain), [1.0, 2.0, 0.3, f64::INFINITY]);
    let numbered = write("id,a\n7,1\n3,2\n").unwrap();
    let mut row = Vec::new();
    let first = numbered.row(0, &mut row);
    assert_eq!((first.id(), first.values()), (3, [2.0].as_slice()));

    let wrong = |text: &str| write(text).unwrap_err();
    assert_eq!(
        wrong("id,a\n7,1\n3,2\n7,3\n"),
        InputError::DuplicateId { id: 7 }
    );
    assert_eq!(wrong("a\n"), InputError::Empty);
    for repeated in ["id", "a"] {
        let name = repeated.to_owned();
        let heads = format!("{repeated},b,{repeated}\n0,100,1.5\n");
        assert_eq!(wrong(&heads), InputError::DuplicateColumn { name });
    }
    let list = Selection::list("0-99999999999").unwrap_err();
    assert!(list.contains("by a range, a..b"), "{list}");
    let cell = wrong("a,b\n1,2\n3,x\n").to_string();
    assert!(
        cell.contains("line 3, column `b`: `x` is not a number"),
        "{cell}"
    );
    for large in ["1e400", "-1e400"] {
        let cell = wrong(&format!("a,b\n1,{large}\n")).to_string();
        let says = format!("`{large}` is not a number that 64 bits can hold");
        assert!(cell.contains(&says), "{cell}");
    }
    let id = wrong("id,a\n-1,2\n").to_string();
    assert!(id.contains("is not a whole number"), "{id}");
    assert!(matches!(wrong("a,b\n1\n"), InputError::File { .. }));
    let absent = Inputs::csv(folder.join("absent.csv")).unwrap_err();
    assert!(matches!(absent, InputError::File { .. }));
}

#[test]
fn inputs_that_make_no_sense_are_refused() {
    let none: [(&str, Vec<f64>); 0] = [];
    assert_eq!(Inputs::grid(none).unwrap_err(), InputError::Empty);
    assert_eq!(
        Inputs::grid([("a", vec![])]).unwrap_err(),
        InputError::Empty
    );
    let axis = || vec![0.0; 100_000];
    let many = Inputs::grid([("a", axis()), ("b", axis())]).unwrap_err();
    assert!(matches!(many, InputError::TooMany { .. }), "{many}");
    for range in [1.0..1.0, 2.0..1.0, 0.0..f64::INFINITY, f64::NAN..1.0] {
        let error = Inputs::latin_hypercube(3, 1, [("a", range)]).unwrap_err();
        assert!(matches!(error, InputError::Range { .. }));
    }
    // From one end of all numbers to the other.
    let all = Inputs::latin_hypercube(9, 1, [("a", f64::MIN..f64::MAX)]).unwrap();
    let mut drawn = values(&all);
    assert!(drawn.iter().all(|value| value.is_finite()), "{drawn:?}");
    drawn.sort_by(f64::total_cmp);
    assert!(drawn[0] < -0.7 * f64::MAX && drawn[8] > 0.7 * f64::MAX);
    let ragged = Inputs::rows(["a", "b"], [vec![1.0, 2.0], vec![3.0]]).unwrap_err();
    assert_eq!(
        ragged,
        InputError::Ragged {
            row: 1,
            given: 1,
            expected: 2
        }
    );
}
