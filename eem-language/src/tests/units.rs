//! Units as text: what can be read, what cannot, and that print can be read again.

use eem_symbolic::Rational;
use proptest::prelude::*;
use syn::{Data, DeriveInput, Field, parse_quote};

use crate::dialect::Dialect;
use crate::unit::Base;
use crate::unit::Unit;
use crate::units::grammar::parse;

fn unit(text: &str) -> Unit {
    parse(text).unwrap_or_else(|message| panic!("{text}: {message:?}"))
}

#[test]
fn the_same_unit_can_be_written_in_many_ways() {
    let same = [
        &[
            "J",
            "N m",
            "N*m",
            "N·m",
            "kg m^2/s^2",
            "kg m² s⁻²",
            "W s",
            "Pa m^3",
            "kg*m^2*s^-2",
        ][..],
        &[
            "J/(kg K)",
            "J/kg/K",
            "J kg^-1 K^-1",
            "m²/(s² K)",
            "J (kg K)^-1",
        ],
        &["1", "m/m", "rad", "rad/sr", "(m/m)^(1/2)", "m^0"],
        &["1/s", "Hz", "s^-1", "s⁻¹", "1/(s)", " 1 / s ", "s^−1"],
        &["kN/m", "N/mm", "kN m^-1", "kN m⁻¹"],
        &["m^(1/2)", "m/m^(1/2)", "(m^2)^(1/4)", "m^( 2 / 4 )"],
        &["min", "min"],
        &["km/h", "km h^-1"],
        &["µm", "μm", "um"],
        &["Ω", "\u{2126}", "ohm", "V/A"],
    ];
    for texts in same {
        for text in texts {
            assert_eq!(unit(text), unit(texts[0]), "{text} = {}", texts[0]);
        }
    }
}

#[test]
fn scales_are_part_of_the_unit() {
    assert_ne!(unit("kN/m"), unit("N/m"));
    assert_eq!(unit("kN/m").coherent(), unit("N/m"));
    assert_eq!(unit("kN/m").expanded(), "1000 N/m");
    assert_eq!(unit("mm").expanded(), "0.001 m");
    assert_eq!(unit("h").expanded(), "3600 s");
    assert_eq!(unit("1/h").expanded(), "1/3600 1/s");
    assert_eq!(unit("m/mm").expanded(), "1000");
    assert_eq!(unit("GPa").expanded(), "1e9 Pa");
    assert_eq!(unit("kN^(1/2)").expanded(), "2^(3/2) 5^(3/2) N^(1/2)");
}

#[test]
fn units_are_printed_as_a_person_would() {
    let texts = [
        "J",
        "N",
        "N/m",
        "J/K",
        "N/(m K)",
        "N s/m",
        "K",
        "1/K",
        "m",
        "m^2",
        "kg",
        "kg/m",
        "N s",
        "W",
        "W/K",
        "Pa",
        "Pa s",
        "m/s",
        "m/s^2",
        "1",
        "J^2",
        "m^(1/2)",
        "N/m^(1/2)",
        "kN/m",
        "mm",
        "GPa",
        "V",
        "C",
        "A",
        "m^2/(s^2 K)",
        "1/mm",
        "Pa/m",
    ];
    for text in texts {
        assert_eq!(unit(text).to_string(), text);
    }
    assert_eq!(unit("kg m^2/s^2").to_string(), "J");
    assert_eq!(unit("kg/s").to_string(), "N s/m");
    assert_eq!(unit("min").to_string(), "60 s");
}

#[test]
fn what_cannot_be_read_says_why() {
    let wrong = [
        ("", "without a symbol"),
        ("  ", "without a symbol"),
        ("J/kg K", "say what is divided by"),
        ("N/m*K", "say what is divided by"),
        ("N/m (K)", "say what is divided by"),
        ("Nm", "did you mean the product `N m`"),
        ("m2", "`m^2`"),
        ("K-1", "`K^-1`"),
        ("m**2", "written with `^`"),
        ("m^x", "an exponent is"),
        ("m^", "an exponent is"),
        ("m^100", "of at most 99"),
        ("m^(1/0)", "an exponent is"),
        ("m^(1/2", "parentheses"),
        ("(m", "parentheses"),
        ("m)", "parentheses"),
        ("1000 N", "belongs to the value"),
        ("1.5", "belongs to the value"),
        ("J/", "missing at the end"),
        ("J·", "missing at the end"),
        ("/s", "`/` is not expected"),
        ("m+s", "`+` is not expected"),
        ("m(s)", "`(` is not expected"),
        ("°C", "absolute temperature"),
        ("foo", "known are"),
    ];
    for (text, part) in wrong {
        let message = parse(text).expect_err(text).whole(Dialect::Attribute, &[]);
        assert!(message.contains(part), "{text}: {message}");
    }
}

#[test]
fn exponents_beyond_128_bits_are_refused() {
    let nested = (0..40).fold("m".to_owned(), |unit, _| format!("({unit})^(98/99)"));
    let message = parse(&nested).expect_err("this does not fit");
    let message = message.whole(Dialect::Attribute, &[]);
    assert!(message.contains("an exponent is"), "{message}");
}

fn pendulum() -> DeriveInput {
    syn::parse2(crate::tests::pendulum()).unwrap()
}

/// The expansion of the pendulum with one field changed, for every field and its unit.
fn changed(change: impl Fn(&mut Field)) -> Vec<(String, String)> {
    let count = pendulum_fields(&mut pendulum()).count();
    let model = |index| {
        let mut model = pendulum();
        let field = pendulum_fields(&mut model).nth(index).unwrap();
        let unit: syn::LitStr = field.attrs[0].parse_args().unwrap();
        change(field);
        (unit.value(), crate::derive::derive(&model).to_string())
    };
    (0..count).map(model).collect()
}

fn pendulum_fields(model: &mut DeriveInput) -> impl Iterator<Item = &mut Field> {
    let Data::Struct(data) = &mut model.data else {
        panic!("the pendulum is a struct");
    };
    data.fields.iter_mut()
}

#[test]
fn the_unit_of_any_field_follows_from_the_others() {
    for (unit, expansion) in changed(|field| field.attrs.clear()) {
        let needs = format!("the formula needs `#[unit(\\\"{unit}\\\")]`");
        assert!(expansion.contains(&needs), "{needs}: {expansion:.400}");
        assert_eq!(expansion.matches("compile_error").count(), 1);
    }
}

#[test]
fn the_units_of_all_fields_follow_from_one() {
    let mut model = pendulum();
    pendulum_fields(&mut model)
        .skip(1)
        .for_each(|field| field.attrs.clear());
    let expansion = crate::derive::derive(&model).to_string();
    assert_eq!(expansion.matches("the formula needs").count(), 10);
}

#[test]
fn any_wrong_unit_is_noticed() {
    let candela: syn::Attribute = parse_quote!(#[unit("cd")]);
    for (unit, expansion) in changed(|field| field.attrs = vec![candela.clone()]) {
        assert!(expansion.contains("compile_error"), "cd instead of {unit}");
    }
    for (unit, expansion) in changed(|_| ()) {
        assert!(!expansion.contains("compile_error"), "{unit}");
    }
}

#[test]
fn bindings_are_looked_at_once() {
    // Written out, the sum has 2²⁰⁰ terms.
    let doubled = (0..200).map(|i| format!("let x{} = x{i} + x{i};", i + 1));
    let doubled: String = doubled.collect();
    let body = format!("{{ let x0 = k * lambda; {doubled} x200 + short }}");
    let body: syn::Expr = syn::parse_str(&body).unwrap();
    let model = parse_quote! {
        #[free_energy(|lambda: Stretch| #body)]
        struct Model {
            #[unit("N")] k: f64,
            #[unit("kJ")] short: f64,
        }
    };
    let expansion = crate::derive::derive(&model).to_string();
    assert!(expansion.contains("`short` is in kJ"), "{expansion:.400}");
}

fn exponent() -> impl Strategy<Value = Rational> {
    (-6i128..=6, 1i128..=4).prop_map(|(n, d)| Rational::new(n, d).unwrap())
}

/// Any product of powers of the base units.
fn coherent() -> impl Strategy<Value = Unit> {
    prop::collection::vec(exponent(), Base::SI.len()).prop_map(|exponents| {
        let powers = Base::SI.into_iter().zip(exponents);
        let powers = powers.map(|(base, e)| Unit::of([(base, 1)]).power(e).unwrap());
        powers.reduce(|a, b| a.times(&b).unwrap()).unwrap()
    })
}

proptest! {
    #[test]
    fn what_is_printed_is_read_as_the_same_unit(unit in coherent()) {
        prop_assert_eq!(parse(&unit.to_string()).ok(), Some(unit));
    }

    #[test]
    fn units_are_a_group_with_powers(a in coherent(), b in coherent(), p in exponent(), q in exponent()) {
        prop_assert_eq!(a.times(&b), b.times(&a));
        prop_assert_eq!(a.times(&b).unwrap().over(&b), Some(a.clone()));
        prop_assert_eq!(a.over(&a), Some(Unit::one()));
        let left = a.times(&b).unwrap().power(p);
        let right = a.power(p).unwrap().times(&b.power(p).unwrap());
        prop_assert_eq!(left, right);
        let both = p.checked_mul(q).unwrap();
        prop_assert_eq!(a.power(p).unwrap().power(q), a.power(both));
    }

    #[test]
    fn no_text_is_too_strange(text in "[ -~µΩ·²⁻°]{0,24}") {
        if let Ok(unit) = parse(&text) {
            prop_assert!(unit.first_unknown().is_none());
        }
    }
}
