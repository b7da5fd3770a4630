"""All kinds of springs that are compiled obey both laws, in all dimensions."""

import eem
import numpy as np
import pytest


@pytest.mark.parametrize("dashpots", [0, 1, 2, 3, 8])
@pytest.mark.parametrize("beside", [False, True], ids=["", "damped"])
@pytest.mark.parametrize("thermal", [False, True], ids=["", "thermal"])
def test_both_laws(thermal, beside, dashpots):
    names = [f"g{k}" for k in range(dashpots)]
    arguments = ["x: Stretch", *(f"{name}: Viscous" for name in names)]
    psi = "20 * (x - 1).powi(2)" + "".join(f" + 5 * (x - 1 - {name}).powi(2)" for name in names)
    if thermal:
        arguments.append("theta: Temperature")
        psi += " - 0.2 * (theta - 300) * (x - 1) + 2 * (theta - 300 - theta * ln(theta / 300))"
    viscosity = {name: f"{4 + k}" for k, name in enumerate(names)}
    if beside:
        viscosity["x"] = "0.3"
    law = eem.Material(f"|{', '.join(arguments)}| {psi}", viscosity=viscosity)
    for dim in (1, 2, 3):
        scene = eem.Scene(dim=dim)
        velocity = [0.5, 1.0, 0.0][:dim]
        mass = scene.mass(1.0, [1.3, 0.2, -0.1][:dim], velocity)
        temperature = {"temperature": 310.0} if thermal else {}
        scene.spring(law, [scene.anchor([0.0] * dim), mass], **temperature)
        run = scene.simulate("eem-temperature", step=0.02)
        run.keep_history()
        record = run.run(until=1.0)
        ledger = record.ledger
        # What dashpots take is heat of the spring, or is lost without a temperature.
        assert abs(ledger.energy - ledger.energy[0]).max() <= record.certificate.bound.sum()
        assert record.gamma.shape == (51, dashpots)
        assert (record.certificate.production >= record.certificate.least_production).all()
        is_damped = beside or dashpots > 0
        if thermal:
            assert (ledger.entropy[-1] > ledger.entropy[0] + 1e-6) == is_damped
        else:
            assert (ledger.lost_heat[-1] > 1e-4) == is_damped
        energy = eem.Objective.at_end("energy")
        if is_damped and not thermal:
            with pytest.raises(eem.GradientError, match="have lost"):
                run.gradient(energy)
            continue
        # The energy at the end is that at the start, whatever the start is.
        assert run.gradient(energy).by_velocity(mass) == pytest.approx(velocity, abs=1e-9)
