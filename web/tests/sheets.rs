//! Sheets that are right, and the places of what is wrong in others.

use eem_web::examples::EXAMPLES;
use eem_web::page::Page;
use eem_web::pendulum::Pendulum;
use eem_web::sheet::{Material, Mistake};

fn mistakes(sheet: &str) -> Vec<Mistake> {
    Material::read(sheet).err().unwrap_or_default()
}

/// Line, column, width and text of what is wrong.
fn places(sheet: &str) -> Vec<([usize; 3], String)> {
    let place = |one: Mistake| ([one.line, one.column, one.width], one.text);
    mistakes(sheet).into_iter().map(place).collect()
}

#[test]
fn examples_run_and_keep_both_laws() {
    for example in &EXAMPLES {
        let material = Material::read(example.sheet).map_err(|all| all[0].drawing.clone());
        let material = material.unwrap_or_else(|drawing| panic!("{}: {drawing}", example.name));
        assert_eq!(material.warnings, [], "{}", example.name);
        for scheme in ["eem-temperature", "eem-entropy"] {
            let run = Pendulum::new(&material.law, &example.setting, scheme);
            let mut run = run.unwrap_or_else(|error| panic!("{}: {error}", example.name));
            for _ in 0..400 {
                if let Err(error) = run.step() {
                    panic!("{}: {error}", example.name);
                }
            }
            let balance = run.balance();
            println!("{}, {scheme}: {balance:?}", example.name);
            assert!(
                balance.drift <= balance.bound && balance.least >= 0.0,
                "{}: {balance:?}",
                example.name
            );
        }
    }
}

#[test]
fn a_fault_is_where_it_stands_in_the_sheet() {
    let psi = "|x: Stretch, g: Viscous| {\n    0.5 * k * (x - gg).powi(2)\n}\n";
    let rest = "k = 3 N/m\n  viscosity g = eta * b\neta = 2 N s/m";
    assert_eq!(
        places(&format!("{psi}{rest}")),
        [
            ([2, 20, 2], "unknown name `gg`".to_owned()),
            ([5, 23, 1], "unknown name `b`".to_owned()),
        ]
    );
    // Parameters in front move nothing, and neither do letters of more than one byte.
    let found = places("k = 3 // größer\n|x: Stretch| k * /* ψ */ y");
    assert_eq!(found, [([2, 26, 1], "unknown name `y`".to_owned())]);
    let found = places("|x: Stretch| k * x\nk = 3 Newton");
    assert_eq!((found.len(), found[0].0), (1, [2, 7, 6]));
    let found = places("|x: Stretch| x.powi(2)\n  k = 3");
    assert_eq!((found.len(), found[0].0), (1, [2, 3, 1]));
}

#[test]
fn a_value_that_is_none_is_drawn() {
    for (line, width) in [
        ("k =", 1),
        ("k = ", 1),
        ("k = x1 N", 2),
        ("k = inf", 3),
        ("k = NaN J", 3),
        ("k = 1e999", 5),
    ] {
        let found = places(&format!("|x: Stretch| k * x\n{line}"));
        assert_eq!(found.len(), 1, "{line}");
        assert_eq!(found[0].0[0], 2, "{line}");
        assert_eq!(
            (found[0].0[2], found[0].1.as_str()),
            (width, "`k` has no value"),
            "{line}"
        );
    }
    let found = mistakes("|x: Stretch| k * x\n\tk = two N");
    assert_eq!(
        found[0].drawing,
        "error: `k` has no value
 --> line 2, column 6
  |
2 |  k = two N
  |      ^^^
  = help: write a number and its unit, as in `k = 100 N/m`"
    );
}

#[test]
fn texts_that_are_no_springs_are_mistakes() {
    for sheet in [
        "",
        "\n\n",
        "viscosity x = 1",
        "k = 1",
        "|e2: StrainSquare| e2",
        "|x: Stretch| (",
        "|x: Stretch| x ^ 2",
        "=",
        "\u{0}",
    ] {
        assert!(!mistakes(sheet).is_empty(), "{sheet:?}");
    }
}

#[test]
fn a_sheet_may_have_several_dashpots() {
    let two = "|x: Stretch, a: Viscous, b: Viscous| (x - a).powi(2) + (x - b).powi(2)\nviscosity a = 1\nviscosity b = 1";
    let law = Material::read(two).ok().map(|material| material.law);
    let run = law.map(|law| Pendulum::new(&law, &EXAMPLES[0].setting, "eem-temperature"));
    let step = run.map(|run| run.and_then(|mut run| run.step().map_err(|error| error.to_string())));
    assert!(matches!(step, Some(Ok(_))), "{step:?}");
}

#[test]
fn a_wrong_sheet_leaves_the_material_that_was_there() {
    let mut page = Page::new();
    let start = |page: &mut Page, speed: &str| {
        page.start(&format!(
            r#"{{"setting": {{"step": 0.1, "mass": 1, "length": 1.5, "speed": {speed}, "gravity": 0, "spring": 300, "air": 300,
            "conductance": 1}}, "schemes": ["eem-entropy", "nonsense", "gauss-4"]}}"#
        ))
    };
    assert_eq!(start(&mut page, "1"), "[]");
    assert!(
        page.read("|x: Stretch| 50 * (x - 1).powi(2)")
            .contains(r#""mistakes":[]"#)
    );
    assert!(
        page.read("|x: Stretch| 50 * (y - 1).powi(2)")
            .contains(r#""law":null"#)
    );
    let said = start(&mut page, "1");
    assert!(said.contains("no scheme is `nonsense`"), "{said}");
    assert_eq!(page.samples().len(), 12);
    assert!(page.advance(0, 50).contains(r#""failure":null"#));
    assert_eq!(page.samples().len(), 300);
    assert!(page.advance(1, 50).contains("no scheme"));
    assert!(page.advance(7, 50).contains("there is no such run"));
    assert!(page.samples().is_empty());
    // JSON has no infinity, so that this is no number.
    assert_eq!(start(&mut page, "1e999"), "[]");
    let said = start(&mut page, "1e300");
    println!("{said}");
    println!("{}", page.advance(0, 5));
}

#[test]
fn a_step_that_fails_says_why_and_ends_its_run() {
    let mut page = Page::new();
    page.read(EXAMPLES[0].sheet);
    let mut setting = EXAMPLES[0].setting;
    setting.step = 0.3;
    let setting = serde_json::to_string(&setting).unwrap_or_default();
    page.start(&format!(
        r#"{{"setting": {setting}, "schemes": ["eem-temperature", "trapezoidal"]}}"#
    ));
    let said = page.advance(0, 1000);
    assert!(said.contains(r#""failure":null"#), "{said}");
    let said = page.advance(1, 1000);
    assert!(said.contains("a smaller step"), "{said}");
    assert!(page.advance(1, 1).contains("a smaller step"));
}
