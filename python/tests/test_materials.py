"""Materials: values, mistakes, formulas, functions of arrays."""

import copy
import pickle

import eem
import numpy as np
import pytest

from conftest import PSI, VALUES


def test_functions_of_arrays(rubber):
    x = np.array([[1.2, 0.1, 310.0], [0.9, -0.2, 290.0]])
    psi, gradient = rubber.psi(x), rubber.gradient(x)
    assert psi.shape == (2,) and psi.dtype == np.float64
    assert gradient.shape == (2, 3) and gradient.dtype == np.float64
    lam, gamma, theta = x.T
    e = np.log(lam)
    expected = (
        50 * e**2 + 10 * (e - gamma) ** 2 - 4 * (theta - 300) * e
        + theta - 300 - theta * np.log(theta / 300)
    )  # fmt: skip
    # Terms of less than 10 J, each with some roundings.
    assert np.abs(psi - expected).max() < 1e-13
    force = (100 * e + 20 * (e - gamma) - 4 * (theta - 300)) / lam
    assert np.abs(gradient[:, 0] - force).max() < 1e-12
    assert np.abs(gradient[:, 1] + 20 * (e - gamma)).max() < 1e-13
    assert np.abs(gradient[:, 2] + 4 * e + np.log(theta / 300)).max() < 1e-13
    assert isinstance(rubber.psi(x[0]), float) and rubber.psi(x[0]) == psi[0]
    assert rubber.gradient(x[None]).shape == (1, 2, 3)
    assert rubber.psi(np.empty((0, 3))).shape == (0,)


def test_a_spring_with_one_variable_takes_numbers(hooke):
    assert hooke.psi(1.5) == 0.5
    assert hooke.gradient([1.5]) == [2.0]
    with pytest.raises(eem.SceneError, match="a last axis of 1 is expected: x"):
        hooke.psi([1.0, 2.0])


def test_what_a_material_says_about_itself(rubber):
    assert rubber.arguments[0] == eem.Argument("lambda", "Stretch", "m")
    assert [argument.role for argument in rubber.arguments] == ["Stretch", "Viscous", "Temperature"]
    assert rubber.parameters == {name: value for name, (value, _) in VALUES.items()}
    assert rubber.units["beta"] == "J/K"
    assert rubber.viscosity == {"gamma": "eta * exp(a / theta)"}
    assert set(rubber.formulas) == {"ψ", "s", "e", "f", "g", "c", "η"}
    assert rubber.formulas["η"] == eem.Formula("η", "η = eta*exp(a/theta)", "N s/m")
    assert r"\eta \, \exp\left(\frac{a}{\theta}\right)" in rubber._repr_latex_()
    assert rubber.text == PSI


def test_latex_is_that_of_the_formula(hooke):
    expected = r"$$\begin{aligned}\psi &= 0.5 \, k \, \left(x - l\right)^{2}\end{aligned}$$"
    assert hooke._repr_latex_() == expected


def test_arrays_of_parameters():
    material = eem.Material("|x: Stretch| 0.5 * k[0] * x.powi(2) + k[1] * x.powi(4)", k=[2.0, 0.5])
    assert material.parameters == {"k[0]": 2.0, "k[1]": 0.5}
    assert material.psi(2.0) == 12.0
    united = eem.Material("|x: Stretch| (k[0] + k[1]) * x.powi(2)", k=([2.0, 0.5], "N/m"))
    assert united.psi(2.0) == 10.0 and united.units == {"k": "N/m"}


def test_a_parameter_may_have_the_name_of_an_argument():
    material = eem.Material("|x: Stretch| viscosity * x.powi(2)", parameters={"viscosity": 3.0})
    assert material.psi(2.0) == 12.0


def test_other_values(rubber):
    stiff = rubber.replace(k=200.0)
    assert stiff.parameters["k"] == 200.0 and rubber.parameters["k"] == 100.0
    with pytest.raises(eem.MaterialError, match="there is no parameter `m`"):
        rubber.replace(m=1.0)
    with pytest.raises(eem.MaterialError, match="has its unit already"):
        rubber.replace(k=(1.0, "J"))


def test_all_mistakes_are_drawn():
    with pytest.raises(eem.MaterialError) as caught:
        eem.Material("|lambda: Stretch| {\n    let e = ln(lamda / l);\n    k * e.powi(2) + z\n}", k=1.0, l=1.0)
    faults = caught.value.faults
    assert [fault.text for fault in faults] == ["unknown name `lamda`", "unknown name `z`"]
    first = faults[0]
    assert (first.part, first.line, first.column, first.width) == ("psi", 2, 16, 5)
    assert first.help == "did you mean `lambda`?"
    drawing = """\
error: unknown name `lamda`
 --> psi, line 2, column 16
  |
2 |     let e = ln(lamda / l);
  |                ^^^^^
  = help: did you mean `lambda`?"""
    assert str(caught.value).startswith(drawing)
    assert isinstance(caught.value, ValueError)


@pytest.mark.parametrize(
    ("values", "message"),
    [
        ({"k": 1.0}, "unknown name `l`"),
        ({"k": float("nan"), "l": 1.0}, "parameter `k` is NaN, it must be finite"),
        ({"k": (1.0, "Newton"), "l": (1.0, "m")}, "unit"),
        ({"k": [[1.0]], "l": 1.0}, "2 dimensions"),
    ],
)
def test_wrong_values(values, message):
    with pytest.raises(eem.MaterialError, match=message):
        eem.Material("|x: Stretch| k * (x - l).powi(2)", **values)


def test_text_is_no_value():
    with pytest.raises(TypeError, match="is text"):
        eem.Material("|x: Stretch| k * x", k="1.0")


def test_what_springs_cannot_be():
    strain = eem.Material("|e: StrainTrace| k * e.powi(2)", k=1.0)
    scene = eem.Scene(dim=1)
    with pytest.raises(eem.MaterialError, match="per volume"):
        scene.spring(strain, [scene.anchor([0.0]), scene.anchor([1.0])])
    assert strain.psi([[0.5]]) == [0.25]
    names = "abcdfghij"
    psi = "|x: Stretch, " + ", ".join(f"{name}: Viscous" for name in names) + "| "
    psi += " + ".join(f"(x - {name}).powi(2)" for name in names)
    with pytest.raises(eem.MaterialError, match="at most 8"):
        eem.Material(psi, viscosity=dict.fromkeys(names, "1"))


def test_no_text_panics():
    for text in ["", "|", "||", "x", "|x: Stretch|", "|x: Stretch| (", "|x: Stretch| 1e999 * x", "\0", "|x: Stretch| " + "(" * 5000, "🦀"]:
        with pytest.raises(eem.MaterialError):
            eem.Material(text)


def test_copies_and_pickles(rubber):
    again = pickle.loads(pickle.dumps(rubber))
    assert repr(again) == repr(rubber)
    x = [1.3, 0.2, 320.0]
    assert again.psi(x) == rubber.psi(x)
    assert again.viscosity == rubber.viscosity and again.units == rubber.units
    assert copy.copy(rubber) is rubber and copy.deepcopy(rubber) is rubber
    named = eem.Material("|x: Stretch| x.powi(2)", name="string")
    assert pickle.loads(pickle.dumps(named)).name == "string"
