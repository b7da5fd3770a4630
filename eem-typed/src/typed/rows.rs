//! Springs of one law that are evaluated together.

use core::ops::Range;
use core::slice;
use std::sync::Arc;

use eem_material::free_energy::{Caloric, Each, FormRows, FreeEnergy, Rows};

use super::{Typed, caloric};
use crate::functions::{Form, Functions, KEPT, Staged};
use crate::shape::Measures;
use crate::tape::{ROW, Tape, WORTH_A_ROW};

impl<
    H: Measures,
    const N: usize,
    const K: usize,
    const V: usize,
    const D: usize,
    const C: usize,
    const R: usize,
> Typed<H, N, K, V, D, C, R>
{
    pub(super) const fn rows() -> Rows<f64, Self> {
        Rows {
            least: WORTH_A_ROW,
            most: ROW,
            temperature_form: FormRows {
                old: |each, found| {
                    let forms = |of| [Some(&in_temperature(of).staged)];
                    Self::keep_of_each(each, forms, found);
                },
                form: |each, found| {
                    let tape = |of| Some(with_tangent(in_temperature(of)));
                    Self::step_of_each(each, |()| &[], tape, found, form_parts);
                },
                response: |each, found| {
                    let tape = |of| Some(alone(in_temperature(of)));
                    Self::step_of_each(each, |()| &[], tape, found, |all| [&mut all[..]]);
                },
            },
            entropy_form: FormRows {
                old: |each, found| {
                    let forms = |of| [Some(&in_entropy(of).staged), of.mixed_states.as_ref()];
                    Self::keep_of_each(each, forms, found);
                },
                form: |each, found| {
                    let tape = |of| Some(with_tangent(in_entropy(of)));
                    Self::step_of_each(each, |corners| corners, tape, found, form_parts);
                },
                response: |each, found| {
                    let tape = |of| Some(alone(in_entropy(of)));
                    Self::step_of_each(each, |corners| corners, tape, found, |all| [&mut all[..]]);
                },
            },
            mixed_states: |each, found| {
                Self::step_of_each(
                    each,
                    |corners| corners,
                    mixed_states,
                    found,
                    |all| [all.as_flattened_mut()],
                );
            },
            viscosity: Self::viscosity_of_each,
            caloric_at: Self::caloric_of_each,
        }
    }

    /// Calls `of_run` for every run of elements with the same tapes: with these, the first element, and the results.
    fn runs<'a, T>(
        model: impl Fn(usize) -> &'a Self,
        mut found: &mut [T],
        mut of_run: impl FnMut(&'a Functions, usize, &mut [T]),
    ) {
        let mut first = 0;
        while !found.is_empty() {
            let functions = &model(first).functions;
            let others = (first + 1..first + found.len()).map(&model);
            let same = others.take_while(|other| Arc::ptr_eq(&other.functions, functions));
            let count = 1 + same.count();
            let (run, rest) = found.split_at_mut(count);
            of_run(functions, first, run);
            first += count;
            found = rest;
        }
    }

    /// The values that forms keep of the old state, one form after the other.
    fn keep_of_each<'a, const F: usize>(
        each: &Each<'_, (&'a Self, &'a [f64; N])>,
        forms: impl Fn(&'a Functions) -> [Option<&'a Staged>; F],
        found: &mut [[f64; KEPT]],
    ) {
        let model = |element| each(element).0;
        Self::runs(model, found, |functions, first, found| {
            found.fill([0.0; KEPT]);
            let inputs = |element: usize| [&each(first + element).1[..]];
            let mut start = 0;
            for form in forms(functions).into_iter().flatten() {
                let kept = start..start + form.old.results();
                start = kept.end;
                form.old
                    .run_rows(inputs, found, |all| [&mut all[kept.clone()]]);
            }
        });
    }

    /// Runs a tape of a step. Its inputs are a range of the kept values, the new variables, and corners.
    fn step_of_each<'a, P: 'a, T, const O: usize>(
        each: &Each<'_, (&'a Self, &'a [f64; KEPT], &'a [f64; N], &'a P)>,
        corners: fn(&P) -> &[f64],
        tape: impl Fn(&'a Functions) -> Option<AndKept<'a>>,
        found: &mut [T],
        parts: impl Fn(&mut T) -> [&mut [f64]; O] + Copy,
    ) {
        let model = |element| each(element).0;
        Self::runs(model, found, |functions, first, found| {
            let Some((tape, kept)) = tape(functions) else {
                return;
            };
            let inputs = |element: usize| {
                let (_, old, x1, memory) = each(first + element);
                [&old[kept.clone()], x1, corners(memory)]
            };
            tape.run_rows(inputs, found, parts);
        });
    }

    fn viscosity_of_each<'a>(
        each: &Each<'_, (&'a Self, &'a f64)>,
        found: &mut [([f64; V], [f64; V])],
    ) {
        let model = |element| each(element).0;
        Self::runs(model, found, |functions, first, found| {
            let inputs = |element: usize| {
                let theta = slice::from_ref(each(first + element).1);
                [if Self::THERMAL { theta } else { &[] }]
            };
            if let Some(tape) = &functions.viscosity {
                tape.run_rows(inputs, found, |(eta, slope)| [&mut eta[..], &mut slope[..]]);
            }
        });
    }

    fn caloric_of_each<'a>(
        each: &Each<'_, (&'a Self, &'a [f64; N])>,
        found: &mut [(Caloric<f64>, f64)],
    ) {
        let model = |element| each(element).0;
        Self::runs(model, found, |functions, first, found| {
            for (row, found) in found.chunks_mut(ROW).enumerate() {
                let first = first + row * ROW;
                let Some(staged) = &functions.caloric_at else {
                    for (element, found) in (first..).zip(found) {
                        let (model, x) = each(element);
                        *found = model.caloric_at(*x)(x[N - 1]);
                    }
                    continue;
                };
                let (mut kept, mut values) = ([[0.0; KEPT]; ROW], [[0.0; 4]; ROW]);
                let (kept, values) = (&mut kept[..found.len()], &mut values[..found.len()]);
                let count = staged.old.results();
                let x = |element: usize| each(first + element).1.split_at(N - 1);
                let old = |element| [x(element).0];
                staged.old.run_rows(old, kept, |kept| [&mut kept[..count]]);
                let new = |element: usize| [&kept[element][..count], x(element).1];
                staged.new.run_rows(new, values, |values| [&mut values[..]]);
                for (found, &[s, c, magnitude, psi]) in found.iter_mut().zip(&*values) {
                    *found = (caloric([s, c, magnitude]), psi);
                }
            }
        });
    }
}

/// The temperature form. Without a temperature both forms are the same.
fn in_temperature(of: &Functions) -> &Form {
    of.temperature_form.as_ref().unwrap_or(&of.entropy_form)
}

fn in_entropy(of: &Functions) -> &Form {
    &of.entropy_form
}

/// A tape, and the range of the kept values that it reads.
type AndKept<'a> = (&'a Tape, Range<usize>);

fn with_tangent(form: &Form) -> AndKept<'_> {
    (&form.staged.new, 0..form.staged.old.results())
}

fn alone(form: &Form) -> AndKept<'_> {
    (&form.response, 0..form.staged.old.results())
}

fn mixed_states(of: &Functions) -> Option<AndKept<'_>> {
    let mixed = of.mixed_states.as_ref()?;
    let first = of.entropy_form.staged.old.results();
    Some((&mixed.new, first..first + mixed.old.results()))
}

/// The parts of a form with its tangent.
fn form_parts<const N: usize, const R: usize>(
    (response, tangent): &mut ([f64; R], [[f64; N]; R]),
) -> [&mut [f64]; 2] {
    [response, tangent.as_flattened_mut()]
}
