"""Scenes: arrays, handles, mistakes, copies."""

import copy
import pickle

import eem
import numpy as np
import pytest


def chain(hooke, count=5):
    scene = eem.Scene(dim=2)
    wall = scene.anchor([0, 0])
    masses = scene.masses(0.5, [[1.1 * k, 0.0] for k in range(1, count + 1)], velocities=[0.0, 1.0])
    nodes = np.concatenate([[wall.index], masses.index])
    springs = scene.springs(hooke, np.column_stack([nodes[:-1], nodes[1:]]))
    return scene, masses, springs


def test_many_at_once_are_one_by_one(hooke):
    scene, masses, springs = chain(hooke)
    single = eem.Scene(dim=2)
    last = single.anchor([0.0, 0.0])
    for k in range(1, 6):
        mass = single.mass(0.5, [1.1 * k, 0.0], [0.0, 1.0])
        single.spring(hooke, [last, mass])
        last = mass
    records = [one.simulate("eem-entropy", step=0.1).run(until=2.0) for one in (scene, single)]
    assert np.array_equal(records[0].q, records[1].q)
    assert len(masses) == len(springs) == 5
    assert repr(scene) == "Scene(dim=2, nodes=6, springs=5, reservoirs=0, paths=0)"


def test_handles(hooke):
    scene, masses, springs = chain(hooke, 9)
    assert masses[0].index == 1 and masses[-1].index == 9
    assert [node.index for node in masses[2:4]] == [3, 4]
    assert masses.index.dtype == np.int64
    assert masses[0] == scene.nodes[1] and hash(masses[0]) == hash(scene.nodes[1])
    assert masses[0] != masses[1] and masses[0] in masses
    assert repr(masses[0]) == "Node(1)" and repr(masses) == "NodeArray([1, 2, 3, ..., 8, 9])"
    assert [10, 20, 30][masses[0]] == 20
    assert scene.elements == springs
    with pytest.raises(IndexError):
        masses[9]


def test_handles_of_other_scenes_are_errors(hooke):
    scene, masses, springs = chain(hooke)
    other, others, _ = chain(hooke)
    with pytest.raises(eem.SceneError, match="node 1 is of another scene"):
        scene.force(others[0], [1, 0])
    run = scene.simulate("eem-entropy", step=0.1)
    with pytest.raises(eem.SceneError, match="of another scene"):
        run.position(others[0])
    late = scene.mass(1.0, [0, 5])
    with pytest.raises(eem.SceneError, match="of another scene"):
        run.position(late)
    with pytest.raises(TypeError, match="a node is expected, not Element"):
        scene.spring(hooke, [masses[0], springs[0]])
    with pytest.raises(eem.SceneError, match="there is no node 99"):
        scene.springs(hooke, [[0, 99]])


@pytest.mark.parametrize(
    ("call", "message"),
    [
        (lambda s, m: s.anchor([0, 0, 0]), r"the position has the shape \(3,\), \(2,\) is expected"),
        (lambda s, m: s.anchor([0, np.nan]), r"the position\[1\] is NaN, it must be finite"),
        (lambda s, m: s.masses([1.0, 2.0], [[0, 0]]), r"masses has the shape \(2,\), \(1,\) or a number"),
        (lambda s, m: s.masses(1.0, [0, 0]), r"positions has the shape \(2,\), \(n, 2\)"),
        (lambda s, m: s.mass([1.0], [0, 0]), r"the mass has the shape \(1,\), a number"),
        (lambda s, m: s.mass(1.0, [0, 0], [1, 0], momentum=[1, 0]), "velocity and momentum"),
        (lambda s, m: s.force(s.nodes[0], [1.0, 0.0]), "node 0"),
        (lambda s, m: s.move_anchor(m[0], lambda t: [t, 0]), "node 1"),
        (lambda s, m: eem.Scene(dim=4), "dim is 4, it must be 1, 2 or 3"),
    ],
)
def test_wrong_arguments_leave_a_scene_unchanged(hooke, call, message):
    scene, masses, _ = chain(hooke)
    before = repr(scene)
    with pytest.raises(eem.SceneError, match=message) as caught:
        call(scene, masses)
    assert isinstance(caught.value, ValueError) and len(caught.value.errors) == 1
    assert repr(scene) == before
    scene.simulate("eem-entropy", step=0.1).run(until=0.3)


def test_a_spring_needs_two_nodes(hooke):
    scene, masses, _ = chain(hooke)
    with pytest.raises(eem.SceneError, match="has two nodes, not 3"):
        scene.spring(hooke, masses[:3])
    with pytest.raises(eem.SceneError):
        scene.spring(hooke, [masses[0], masses[0]])
    assert len(scene.elements) == 5


def test_all_errors_of_a_scene_are_told_at_once(rubber):
    scene = eem.Scene(dim=1)
    ends = [scene.anchor([0.0]), scene.mass(-1.0, [1.0])]
    scene.spring(rubber, ends, temperature=-3.0)
    scene.reservoir(0.0)
    with pytest.raises(eem.SceneError, match="things are wrong with the scene") as caught:
        scene.simulate("eem-entropy", step=0.1)
    assert any("mass of node 1 is -1 kg" in error for error in caught.value.errors)
    assert any("reservoir 0" in error for error in caught.value.errors)


def test_names_of_schemes(hooke):
    scene, *_ = chain(hooke)
    with pytest.raises(ValueError, match="take one of auto, eem-entropy, eem-temperature"):
        scene.simulate("euler", step=0.1)
    with pytest.raises(eem.SceneError, match="step"):
        scene.simulate("eem-entropy", step=-0.1)
    with pytest.raises(eem.SceneError, match="give a `step`, a `tolerance`, or both"):
        scene.simulate("eem-entropy")


def test_copies_go_their_own_way(hooke):
    scene, masses, springs = chain(hooke)
    for twin in (copy.copy(scene), copy.deepcopy(scene), pickle.loads(pickle.dumps(scene))):
        twin.force(masses[-1], [3.0, 0.0])
        extra = twin.mass(1.0, [9, 9])
        pushed = twin.simulate("eem-entropy", step=0.1).run(until=1.0)
        free = scene.simulate("eem-entropy", step=0.1).run(until=1.0)
        assert pushed.position(masses[-1])[-1, 0] > free.position(masses[-1])[-1, 0] + 0.1
        assert pushed.position(extra)[-1, 0] == 9.0
        with pytest.raises(eem.SceneError):
            free.position(extra)
        assert len(twin.nodes) == len(scene.nodes) + 1


def test_a_pickled_scene_runs_with_the_same_bits(pendulum):
    scene, spring, bob = pickle.loads(pickle.dumps((pendulum.scene, pendulum.spring, pendulum.bob)))
    one = pendulum.scene.simulate("eem-temperature", step=0.05).run(until=2.0)
    two = scene.simulate("eem-temperature", step=0.05).run(until=2.0)
    assert np.array_equal(one.q, two.q) and np.array_equal(one.theta, two.theta)
    assert np.array_equal(two.temperature(spring), one.temperature(pendulum.spring))
    assert np.array_equal(two.position(bob), one.position(pendulum.bob))


def test_a_state_at_rest(hooke):
    scene = eem.Scene(dim=2)
    hook = scene.anchor([0, 0])
    weight = scene.mass(2.0, [0.3, -1.0])
    spring = scene.spring(hooke, [hook, weight])
    scene.set_gravity([0, -10.0])
    report = scene.equilibrium()
    assert report["residual"] < 1e-12
    for same in (scene, pickle.loads(pickle.dumps(scene))):
        run = same.simulate("eem-entropy", step=0.1)
        # 20 N stretch a spring of 4 N/m by 5 m.
        assert abs(run.stretch(spring) - 6.0) < 1e-13
    free = eem.Scene(dim=2)
    free.mass(1.0, [0, 0])
    with pytest.raises(eem.EquilibriumError, match="nothing holds"):
        free.equilibrium()


def test_conduction_between_many(rubber):
    scene = eem.Scene(dim=2)
    nodes = scene.anchors([[0, 0], [1, 0], [2, 0]])
    springs = scene.springs(rubber, [nodes[:2], nodes[1:]], temperature=[300.0, 400.0])
    path = scene.conduct(springs[0], springs[1], 1.0)
    assert path.index == 0
    walls = scene.reservoirs([310.0, 320.0])
    assert len(scene.conduct(springs, walls, 0.5)) == 2
    with pytest.raises(eem.SceneError, match="2 springs have 3 partners"):
        scene.conduct(springs, [springs[0]] * 3, 0.5)
    record = scene.simulate("eem-temperature", step=0.1).run(until=50.0)
    assert np.all((record.theta[-1] > 309.0) & (record.theta[-1] < 321.0))
    assert np.all(np.diff(record.ledger.entropy) >= -1e-12)


def test_viscous_stretches_at_the_start(rubber):
    scene = eem.Scene(dim=1)
    ends = [scene.anchor([0.0]), scene.mass(1.0, [1.2])]
    spring = scene.spring(rubber, ends, temperature=300.0, viscous_stretch=[0.1])
    run = scene.simulate("eem-entropy", step=0.1)
    assert run.viscous_stretch(spring) == 0.1 and run.viscous_stretch(spring, 0) == 0.1
    with pytest.raises(eem.SceneError):
        run.viscous_stretch(spring, 1)


def test_a_function_cannot_change_the_scene_that_calls_it(hooke):
    scene = eem.Scene(dim=1)
    mass = scene.mass(1.0, [1.0])
    scene.spring(hooke, [scene.anchor([0.0]), mass])

    def force(t):
        scene.mass(1.0, [2.0])
        return [1.0]

    scene.force(mass, force)
    with pytest.raises(RuntimeError, match="the scene is in use"):
        scene.equilibrium()
    assert len(scene.nodes) == 2
