//! Whatever is written, the derive answers with code or with messages: no panic, no broken output.
//!
//! Models are damaged token by token, at random and the same way in every run. `EEM_MUTATIONS`
//! sets their number.

use proc_macro2::{Group, TokenStream, TokenTree};
use syn::DeriveInput;

/// Models with something of everything; short, because every mutation may be expanded.
const MODELS: [&str; 7] = [
    "#[free_energy(|lambda: Stretch, gamma: Viscous, theta: Temperature| {
        let strain = ln(lambda / length);
        k * strain.powi(2) + (lambda + gamma.powi(2)).powf(1.5) - c * theta * ln(theta / 300)
    })]
    #[viscosity(gamma = eta * exp(300 / theta))]
    struct Spring<T: Copy> { length: f64, k: f64, c: f32, eta: f64, name: T }",
    "#[free_energy(crate = ::eem, |x: Stretch| {
        let y = { let z = x - 1; abs(a) * z * diff(x * a, x) };
        y + sqrt(x) / tanh(2.5e-1) - powi(x, 3)
    })]
    struct Bond { a: f64, #[free_energy(unused)] b: f64 }",
    "#[free_energy(|x: Stretch, a: Viscous, b: Viscous| (x - a) * (x - b))]
    #[viscosity(a = 1 / 2)]
    #[viscosity(b = { let k = c; k * k })]
    struct Branches { c: f64 }",
    "#[free_energy(|x: Stretch, t: Temperature| x.powi(2) - t * t.ln() + asinh(x).cbrt())]
    struct Unit;",
    "#[free_energy(|e1: StrainTrace, e2: StrainSquare, j: Dilatation, g: Viscous, t: Temperature| {
        let l = ln_1p(j);
        a * (e1 - g).powi(2) + b * e2 / (1 + j) - t * l + sqrt(1 + e2) * (1 + j).powf(-1.5) - t * ln(t)
    })]
    #[viscosity(g = a / t)]
    struct Solid { #[unit(\"Pa\")] a: f64, b: f64 }",
    "#[free_energy(|x: Stretch, g: Viscous| {
        let f = |a, b| { let c = a * b; c + g };
        let h = |a| f(a, a) * f(x, 2);
        k * h(x) + f(h(x), 1)
    })]
    #[viscosity(g = { let f = |a| a * a; f(k) })]
    struct Helpers { #[unit(\"N/m\")] k: f64 }",
    "#[free_energy(|x: Stretch| k[0] * x + k[1] * R * x.powi(2) / crate::L * PI + core::f64::consts::E * k[0])]
    #[unit(R = \"1\", crate::L = \"m\")]
    struct Chain { #[unit(\"N\")] k: [f64; 2], _rest: [f32; 3] }",
];

/// Tokens that mistakes are made of.
const FOREIGN: &str = "a x lambda theta zeta Stretch Viscous e1 j Dilatation StrainTrace 0 1 -1 2.5 1e999 \"s\" 'c' true + - * / ^ % & ! ? \
    = == < .. ; , : :: . | || => ln exp powi diff abs sqrt if else match for return let mut fn const \
    unsafe async self as _ ( ) { } [ ] crate unused f h |a| f(x) k R k[1] [2] [f64;2] #[viscosity] 2u8 r#type struct";

/// xorshift64*, Vigna 2016.
struct Random(u64);

impl Random {
    fn below(&mut self, bound: usize) -> usize {
        self.0 ^= self.0 >> 12;
        self.0 ^= self.0 << 25;
        self.0 ^= self.0 >> 27;
        let value = self.0.wrapping_mul(0x2545_f491_4f6c_dd1d) >> 33;
        usize::try_from(value).expect("31 bits") % bound
    }
}

/// One change somewhere in the tokens: something is left out, doubled, exchanged or put in. Mostly
/// inside of the attributes: what is around them is not for the derive to judge.
fn mutate(
    tokens: TokenStream,
    random: &mut Random,
    foreign: &[TokenTree],
    depth: usize,
) -> TokenStream {
    let mut tokens: Vec<TokenTree> = tokens.into_iter().collect();
    let groups = tokens.iter().enumerate();
    let groups = groups.filter(|(_, token)| matches!(token, TokenTree::Group(_)));
    let groups: Vec<usize> = groups.map(|(index, _)| index).collect();
    if !groups.is_empty() && random.below(if depth < 2 { 64 } else { 2 }) > 0 {
        let at = groups[random.below(groups.len())];
        if let TokenTree::Group(group) = &tokens[at] {
            let inner = mutate(group.stream(), random, foreign, depth + 1);
            tokens[at] = Group::new(group.delimiter(), inner).into();
        }
        return tokens.into_iter().collect();
    }
    if tokens.is_empty() {
        return TokenStream::new();
    }
    let at = random.below(tokens.len());
    let other = random.below(tokens.len());
    let stranger = foreign[random.below(foreign.len())].clone();
    match random.below(5) {
        0 => drop(tokens.remove(at)),
        1 => tokens.insert(other, tokens[at].clone()),
        2 => tokens.swap(at, other),
        3 => tokens[at] = stranger,
        _ => tokens.insert(at, stranger),
    }
    tokens.into_iter().collect()
}

#[test]
fn damaged_models_are_answered() {
    let words = FOREIGN.split_whitespace();
    let foreign: TokenStream = words
        .filter_map(|word| word.parse::<TokenStream>().ok())
        .collect();
    let foreign: Vec<TokenTree> = foreign.into_iter().collect();
    let mutations = std::env::var("EEM_MUTATIONS").ok();
    let mutations = mutations.map_or(500, |text| text.parse().expect("a number"));
    let (mut sound, mut wrong) = (0, 0);
    for seed in 1..=mutations {
        let mut random = Random(
            u64::try_from(seed)
                .expect("64 bits")
                .wrapping_mul(0x9e37_79b9_7f4a_7c15),
        );
        let model = MODELS[random.below(MODELS.len())];
        let mut tokens: TokenStream = model.parse().expect("the model is Rust");
        for _ in 0..=random.below(4) {
            tokens = mutate(tokens, &mut random, &foreign, 0);
        }
        let text = tokens.to_string();
        let Ok(input) = syn::parse2::<DeriveInput>(tokens) else {
            continue;
        };
        let answer = std::panic::catch_unwind(|| crate::derive::derive(&input).to_string());
        let answer = answer.unwrap_or_else(|_| panic!("the derive panics for\n{text}"));
        assert!(
            syn::parse_str::<syn::File>(&answer).is_ok(),
            "no Rust comes out for\n{text}"
        );
        if answer.contains("compile_error") {
            wrong += 1;
        } else {
            sound += 1;
        }
    }
    // Otherwise the damage is too small or too large to say anything.
    assert!(
        sound > mutations / 50 && wrong > mutations / 5,
        "{sound} sound, {wrong} wrong"
    );
}
