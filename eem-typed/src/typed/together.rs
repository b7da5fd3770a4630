//! Springs of one law that are evaluated together.

use core::slice;

use eem_material::free_energy::{Caloric, ExactForm, MOST_TOGETHER, Steps, Together};

use crate::functions::{Form, Functions, caloric};
use crate::shape::KEPT;
use crate::tape::{ROW, Tape, WORTH_A_ROW};

const _: () = assert!(ROW == MOST_TOGETHER, "a call fills a row");

impl<const N: usize, const V: usize, const C: usize, const R: usize>
    Together<[f64; N], [f64; V], [f64; C], [f64; R], [[f64; N]; R]> for Functions
{
    fn least(&self) -> usize {
        WORTH_A_ROW
    }

    fn keep(&self, form: ExactForm, x0: &[[f64; N]], kept: &mut [&mut [f64]]) {
        let (form, functions) = self.form(form);
        let mixed = self.mixed_states.as_ref();
        let mixed = mixed.filter(|_| form == ExactForm::Entropy);
        let mut start = 0;
        for staged in [Some(&functions.staged), mixed].into_iter().flatten() {
            let place = start..start + staged.old.results();
            start = place.end;
            let inputs = |element: usize| [&x0[element][..]];
            (staged.old).run_rows(inputs, kept, |kept| [&mut kept[place.clone()]]);
        }
    }

    fn form(
        &self,
        form: ExactForm,
        steps: Steps<'_, [f64; N], [f64; C]>,
        found: &mut [([f64; R], [[f64; N]; R])],
    ) {
        let (form, Form { staged, .. }) = self.form(form);
        let inputs = inputs_of(form, (0, &staged.old), steps);
        staged.new.run_rows(inputs, found, |(response, tangent)| {
            [&mut response[..], tangent.as_flattened_mut()]
        });
    }

    fn response(
        &self,
        form: ExactForm,
        steps: Steps<'_, [f64; N], [f64; C]>,
        found: &mut [[f64; R]],
    ) {
        let (form, Form { staged, response }) = self.form(form);
        let inputs = inputs_of(form, (0, &staged.old), steps);
        response.run_rows(inputs, found, |response| [&mut response[..]]);
    }

    fn mixed_states(&self, steps: Steps<'_, [f64; N], [f64; C]>, found: &mut [[[f64; C]; 2]]) {
        if let Some(mixed) = &self.mixed_states {
            let first = self.entropy_form.staged.old.results();
            let inputs = inputs_of(ExactForm::Entropy, (first, &mixed.old), steps);
            mixed
                .new
                .run_rows(inputs, found, |found| [found.as_flattened_mut()]);
        }
    }

    fn viscosity(&self, theta: &[f64], found: &mut [([f64; V], [f64; V])]) {
        if let Some(tape) = &self.viscosity {
            let is_input = self.is_thermal();
            let inputs = |element: usize| {
                let theta = slice::from_ref(&theta[element]);
                [if is_input { theta } else { &[] }]
            };
            tape.run_rows(inputs, found, |(eta, slope)| [&mut eta[..], &mut slope[..]]);
        }
    }

    fn caloric_at(&self, x: &[[f64; N]], found: &mut [(Caloric<f64>, f64)]) {
        let Some(staged) = &self.caloric_at else {
            return;
        };
        let (mut kept, mut values) = ([[0.0; KEPT]; ROW], [[0.0; 4]; ROW]);
        let (kept, values) = (&mut kept[..x.len()], &mut values[..x.len()]);
        let count = staged.old.results();
        let old = |element: usize| [&x[element][..N - 1]];
        staged.old.run_rows(old, kept, |kept| [&mut kept[..count]]);
        let new = |element: usize| [&kept[element][..count], &x[element][N - 1..]];
        staged.new.run_rows(new, values, |values| [&mut values[..]]);
        for (found, &[s, c, magnitude, psi]) in found.iter_mut().zip(&*values) {
            *found = (caloric([s, c, magnitude]), psi);
        }
    }
}

impl Functions {
    /// A form. Without a temperature both are that of the entropy.
    fn form(&self, form: ExactForm) -> (ExactForm, &Form) {
        match &self.temperature_form {
            Some(in_temperature) if form == ExactForm::Temperature => (form, in_temperature),
            _ => (ExactForm::Entropy, &self.entropy_form),
        }
    }
}

/// The inputs of a tape of a step: what an `old` tape keeps from the `first` of the kept values, the new variables, and in
/// entropy form the corners.
fn inputs_of<'a, const N: usize, const C: usize>(
    form: ExactForm,
    (first, old): (usize, &Tape),
    steps: Steps<'a, [f64; N], [f64; C]>,
) -> impl Fn(usize) -> [&'a [f64]; 3] {
    let kept = first..first + old.results();
    move |element| {
        let corners: &[f64] = match form {
            ExactForm::Entropy => &steps.corners[element],
            ExactForm::Temperature => &[],
        };
        [
            &steps.kept[element][kept.clone()],
            &steps.x1[element],
            corners,
        ]
    }
}
