//! Room that was made for one model, given with another.

use eigenbody::dynamics::*;
use eigenbody::factor::{
    CoupledWorkspace, coupled_bias_force_into, coupled_forward_dynamics_into, coupled_inverse_dynamics_into,
};
use eigenbody::model::{JointSpec, MimicSpec};
use eigenbody::spatial::{RigidInertia, Sym3, Transform, Vec3};
use eigenbody::spectrum::{EndsAtWorkspace, Metric, extreme_eigenvalues_at};
use eigenbody::{Base, Error, Family, InputError, Joint, Matrix, Model, ModelBuilder};

/// What each door gives, where all its room is that of a model.
struct Rooms {
    crba: CrbaWorkspace<f64>,
    rnea: RneaWorkspace<f64>,
    aba: AbaWorkspace<f64>,
    momentum: MomentumWorkspace<f64>,
    gradient: GradientWorkspace<f64>,
    ends: EndsAtWorkspace<f64>,
    floating: Option<FloatingWorkspace<f64>>,
}

type Door = (&'static str, Result<Vec<f64>, Error>);

impl Rooms {
    fn new(model: &Model<f64>) -> Self {
        Self {
            crba: CrbaWorkspace::new(model),
            rnea: RneaWorkspace::new(model),
            aba: AbaWorkspace::new(model),
            momentum: MomentumWorkspace::new(model),
            gradient: GradientWorkspace::new(model),
            ends: EndsAtWorkspace::new(model, &Metric::Euclidean).unwrap(),
            floating: FloatingWorkspace::new(model).ok(),
        }
    }

    fn results(&mut self, model: &Model<f64>) -> Vec<Door> {
        let (nv, q) = (model.nv(), model.random(3));
        let v: Vec<f64> = (0..nv).map(|d| 0.1 * d as f64 - 0.2).collect();
        let Self { crba, rnea, aba, momentum, gradient, ends, floating } = self;
        let mut H = Matrix::zeros(nv, nv);
        let filled = |done: Result<(), InputError>, x: &[f64]| done.map(|()| x.to_vec()).map_err(Error::from);
        let mut x = vec![0.0; nv];
        let mut doors = vec![
            ("mass_matrix_into", filled(mass_matrix_into(model, &q, crba, &mut H), H.as_slice())),
            ("inverse_dynamics_into", filled(inverse_dynamics_into(model, &q, &v, &v, rnea, &mut x), &x)),
            ("bias_force_into", filled(bias_force_into(model, &q, &v, rnea, &mut x), &x)),
            ("gravity_force_into", filled(gravity_force_into(model, &q, rnea, &mut x), &x)),
            (
                "forward_dynamics_into",
                forward_dynamics_into(model, &q, &v, &v, aba, &mut x).map(|()| x.clone()),
            ),
            (
                "kinetic_energy_gradient_into",
                filled(kinetic_energy_gradient_into(model, &q, &v, gradient, &mut x), &x),
            ),
            (
                "momentum_into",
                momentum_into(model, &q, &v, momentum).map(|p| p.h.to_array().to_vec()).map_err(Error::from),
            ),
            (
                "energy_into",
                energy_into(model, &q, &v, momentum).map(|e| vec![e.kinetic]).map_err(Error::from),
            ),
            (
                "extreme_eigenvalues_at",
                extreme_eigenvalues_at(model, &q, ends).map(|ends| ends.to_vec()).map_err(Error::from),
            ),
        ];
        let upper = mass_matrix_upper_into(model, &q, crba, &mut H);
        doors.push(("mass_matrix_upper_into", filled(upper, H.row(0))));
        if let (Some(floating), true) = (floating, model.has_floating_base()) {
            let mut H = Matrix::zeros(nv - 6, nv - 6);
            let done = floating_mass_matrix_into(model, &q, floating, &mut H);
            doors.push(("floating_mass_matrix_into", done.map(|()| H.as_slice().to_vec())));
        }
        doors
    }
}

/// As many bodies, or as many degrees of freedom, or both, do not make it the same model.
#[test]
fn room_of_another_model_is_refused() {
    let hydra = |n| Family::hydra(n, 1.0, 0.4, 1.0).unwrap();
    let models: Vec<Model<f64>> = [
        hydra(4),
        hydra(9),
        Family::hydra(9, 2.0, 0.4, 1.0).unwrap(),
        hydra(70),
        hydra(4).floating(),
        Family::auto_tree(9, 1.5, 0.3, 0.9).unwrap(),
        Family::auto_tree(9, 1.5, 0.3, 0.9).unwrap().floating(),
    ]
    .into_iter()
    .map(|family| family.model().unwrap())
    .collect();
    for (i, of) in models.iter().enumerate() {
        for (j, model) in models.iter().enumerate() {
            for (door, result) in Rooms::new(of).results(model) {
                match i == j {
                    true => assert!(result.is_ok(), "{door} of {i}: {result:?}"),
                    false => assert_eq!(
                        result,
                        Err(InputError::OtherModel { what: "workspace" }.into()),
                        "{door} with room of {i} for {j}"
                    ),
                }
            }
        }
    }
}

#[test]
fn the_refusal_says_what_is_wrong() {
    assert_eq!(
        InputError::OtherModel { what: "workspace" }.to_string(),
        "workspace was made for a model with other bodies or joints"
    );
}

/// Rods so long against their thickness that single configurations take another way, and the same tree with stout ones.
#[test]
fn room_serves_all_models_of_a_shape() {
    let heavy = RigidInertia::from_com(3.0, Vec3::new(0.2, 0.1, -0.3), Sym3::diagonal(0.3, 0.4, 0.5));
    let thin = RigidInertia::from_com(1.0, Vec3::new(0.0, 0.0, 1.0e3), Sym3::diagonal(1e-9, 1e-9, 1e-9));
    for family in [Family::auto_tree(9, 1.5, 0.3, 0.9).unwrap(), Family::hydra(7, 1.5, 0.3, 0.9).unwrap()] {
        let stout = family.clone().floating().model::<f64>().unwrap();
        let tip = stout.links().len() - 1;
        let others = [heavy, thin].map(|inertia| stout.clone().with_inertia(tip, inertia).unwrap());
        let models = [&stout, &others[0], &others[1]];
        for of in models {
            for model in models {
                let expected = Rooms::new(model).results(model);
                for ((door, found), (_, expected)) in Rooms::new(of).results(model).into_iter().zip(expected)
                {
                    match door {
                        // The central body stays that of the first model: what is rounded is the inertia of all, seen from there.
                        "floating_mass_matrix_into" => {
                            let whole = mass_matrix(model, &model.random(3)).unwrap().max_abs();
                            close(&found.unwrap(), &expected.unwrap(), whole);
                        }
                        _ => assert_eq!(found, expected, "{door}"),
                    }
                }
            }
        }
    }
}

/// To 100 ε of what governs.
fn close(found: &[f64], expected: &[f64], governs: f64) {
    for (found, expected) in found.iter().zip(expected) {
        assert!((found - expected).abs() <= 100.0 * f64::EPSILON * governs, "{found} {expected}");
    }
}

/// As many degrees of freedom on one body and on six: what was factored for one does not serve the other.
#[test]
fn factors_of_another_mechanism_are_refused() {
    let free = Family::hydra(1, 1.0, 0.4, 1.0).unwrap().floating().model::<f64>().unwrap();
    let arm = Family::hydra(free.nv(), 1.0, 0.4, 1.0).unwrap().model::<f64>().unwrap();
    for (of, other) in [(&free, &arm), (&arm, &free)] {
        let [mut own, mut denoc] = [of, other].map(Denoc::new);
        own.update(&of.random(1)).unwrap();
        denoc.update(&other.random(1)).unwrap();
        let mut udu = Udu::new(&own);
        let refused = InputError::OtherModel { what: "denoc" };
        assert_eq!(udu.factor(&denoc), Err(refused.clone().into()));
        assert_eq!(udu.solve(&denoc, &mut vec![1.0; other.nv()]), Err(refused.clone()));
        assert_eq!(udu.reconstruct(&denoc).map(|_| ()), Err(refused));
    }
}

/// `fingers` fingers on a palm, all but `free` of them following the first.
fn hand(fingers: usize, free: usize) -> Model<f64> {
    let mut hand = ModelBuilder::new("hand");
    let palm = hand.link("palm", RigidInertia::ZERO);
    for i in 0..fingers {
        let inertia = RigidInertia::from_com(1.0, Vec3::X, Sym3::diagonal(1.0, 1.0, 1.0));
        let finger = hand.link(format!("finger_{i}"), inertia);
        let joint = JointSpec::new(format!("joint_{i}"), Joint::Revolute, palm, finger);
        let mimic = MimicSpec { joint: "joint_0".into(), multiplier: 2.0, offset: 0.0 };
        let joint = joint.at(Transform::translation(Vec3::Y));
        hand.joint(JointSpec { mimic: (i >= free).then_some(mimic), ..joint });
    }
    hand.build(Base::Fixed).unwrap()
}

#[test]
fn coupled_room_and_maps_of_another_model_are_refused() {
    let hands = [hand(2, 1), hand(4, 1), hand(4, 2), hand(4, 3)];
    for (i, room) in hands.iter().enumerate() {
        for (j, map) in hands.iter().enumerate() {
            for (k, model) in hands.iter().enumerate() {
                let coupling = map.coupling().unwrap();
                let mut workspace = CoupledWorkspace::new(room, room.coupling().unwrap()).unwrap();
                let (q, rate) = (model.neutral(), vec![0.1; coupling.nv()]);
                let mut out = rate.clone();
                let inverse = coupled_inverse_dynamics_into(
                    model,
                    coupling,
                    &q,
                    &rate,
                    &rate,
                    &mut workspace,
                    &mut out,
                );
                let bias = coupled_bias_force_into(model, coupling, &q, &rate, &mut workspace, &mut out);
                let forward = coupled_forward_dynamics_into(
                    model,
                    coupling,
                    &q,
                    &rate,
                    &rate,
                    &mut workspace,
                    &mut out,
                );
                let (same_tree, same_map) = ((i == 0) == (k == 0), (j == 0) == (k == 0));
                let expected = match (same_tree, same_map) {
                    (false, _) => Err(InputError::OtherModel { what: "workspace" }),
                    (_, false) => Err(InputError::OtherModel { what: "coupling" }),
                    _ if i != j => Err(InputError::OtherModel { what: "workspace" }),
                    _ => Ok(()),
                };
                assert_eq!(inverse, expected, "{i} {j} {k}");
                assert_eq!(bias, expected, "{i} {j} {k}");
                assert_eq!(forward, expected.map_err(Error::from), "{i} {j} {k}");
            }
        }
    }
}
