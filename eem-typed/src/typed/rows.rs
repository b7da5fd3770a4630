//! Springs of one law that are evaluated together.

use core::slice;
use std::sync::Arc;

use eem_material::free_energy::{Caloric, Each, FormRows, FreeEnergy, Rows};
use eem_material::number::scalar::Scalar;

use super::{Typed, caloric};
use crate::functions::{Functions, KEPT};
use crate::shape::Measures;
use crate::tape::ROW;

/// A form with its tangent.
type Form<S, const N: usize, const R: usize> = ([S; R], [[S; N]; R]);

impl<
    S: Scalar,
    H: Measures,
    const N: usize,
    const K: usize,
    const V: usize,
    const D: usize,
    const C: usize,
    const R: usize,
> Typed<S, H, N, K, V, D, C, R>
{
    pub(super) const fn rows() -> Rows<S, Self> {
        Rows {
            most: ROW,
            temperature_form: FormRows {
                old: Self::old_of_each,
                form: Self::form_of_each,
                response: Self::response_of_each,
            },
            viscosity: Self::viscosity_of_each,
            caloric_at: Self::caloric_of_each,
        }
    }

    /// Calls a function for every run of elements with the same tapes: with the first of them, and their results.
    fn runs<'a, T>(
        model: impl Fn(usize) -> &'a Self,
        mut found: &mut [T],
        mut of_run: impl FnMut(&'a Functions<S>, usize, &mut [T]),
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

    fn old_of_each<'a>(each: &Each<'_, (&'a Self, &'a [S; N])>, found: &mut [[S; KEPT]]) {
        let model = |element| each(element).0;
        Self::runs(model, found, |functions, first, found| {
            let Some(form) = &functions.temperature_form else {
                for (element, found) in (first..).zip(found) {
                    let (model, x0) = each(element);
                    *found = model.temperature_form_old(x0);
                }
                return;
            };
            found.fill([S::zero(); KEPT]);
            let tape = &form.staged.old;
            let inputs = |element: usize| [&each(first + element).1[..]];
            tape.run_rows(inputs, found, |kept| [&mut kept[..tape.results()]]);
        });
    }

    fn form_of_each<'a>(
        each: &Each<'_, (&'a Self, &'a [S; KEPT], &'a [S; N])>,
        found: &mut [Form<S, N, R>],
    ) {
        let model = |element| each(element).0;
        Self::runs(model, found, |functions, first, found| {
            let form = functions.temperature_form.as_ref();
            let corners = [S::zero(); C];
            let staged = &form.unwrap_or(&functions.entropy_form).staged;
            let corners = if form.is_some() { &[] } else { &corners[..] };
            let inputs = |element: usize| {
                let (_, old, x1) = each(first + element);
                [&old[..staged.old.results()], x1, corners]
            };
            staged.new.run_rows(inputs, found, |(response, tangent)| {
                [&mut response[..], tangent.as_flattened_mut()]
            });
        });
    }

    fn response_of_each<'a>(
        each: &Each<'_, (&'a Self, &'a [S; KEPT], &'a [S; N])>,
        found: &mut [[S; R]],
    ) {
        let model = |element| each(element).0;
        Self::runs(model, found, |functions, first, found| {
            let form = functions.temperature_form.as_ref();
            let corners = [S::zero(); C];
            let own = form.unwrap_or(&functions.entropy_form);
            let corners = if form.is_some() { &[] } else { &corners[..] };
            let inputs = |element: usize| {
                let (_, old, x1) = each(first + element);
                [&old[..own.staged.old.results()], x1, corners]
            };
            own.response
                .run_rows(inputs, found, |response| [&mut response[..]]);
        });
    }

    fn viscosity_of_each<'a>(each: &Each<'_, (&'a Self, &'a S)>, found: &mut [([S; V], [S; V])]) {
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

    fn caloric_of_each<'a>(each: &Each<'_, (&'a Self, &'a [S; N])>, found: &mut [(Caloric<S>, S)]) {
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
                let (mut kept, mut values) = ([[S::zero(); KEPT]; ROW], [[S::zero(); 4]; ROW]);
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
