//! Ends of spectra that matrices in lanes do not know well: clusters, sizes beyond squares, no inertia.

use eigenbody::batch::{Batch, BatchError};
use eigenbody::model::JointSpec;
use eigenbody::spatial::{RigidInertia, Sym3, Vec3};
use eigenbody::{Base, Error, InputError, Joint, Metric, Model, ModelBuilder};

const COUNT: usize = 20;

/// Wheels on one hub: H is the diagonal of their inertias.
fn wheels(inertias: &[f64]) -> Model<f64> {
    let mut robot = ModelBuilder::new("wheels");
    let hub = robot.link("hub", RigidInertia::ZERO);
    for (k, &inertia) in inertias.iter().enumerate() {
        let I = RigidInertia::from_com(inertia, Vec3::ZERO, Sym3::diagonal(inertia, inertia, inertia));
        let wheel = robot.link(format!("wheel {k}"), I);
        robot.joint(JointSpec::new(format!("hinge {k}"), Joint::Revolute, hub, wheel).about(Vec3::Z));
    }
    robot.build(Base::Fixed).unwrap()
}

fn ends(model: &Model<f64>, metric: &Metric<f64>) -> Result<Vec<f64>, BatchError> {
    let (q, mut ends) = (vec![0.3; COUNT * model.nq()], vec![f64::NAN; 2 * COUNT]);
    Batch::new(model).extremes(&q, metric, 1e-8, &mut ends).map(|()| ends)
}

/// Half of the eigenvalues together, the slowest case of Laguerre's method, at either end; of any size.
#[test]
fn clusters_are_reached_whatever_their_size() {
    for n in [2, 6, 32, 64, 97] {
        for size in [1.0, 1e-120, 1e120] {
            let inertias: Vec<f64> = (0..n).map(|k| size * if k % 2 == 0 { 1e-3 } else { 1.0 }).collect();
            let bound = 8.0 * n as f64 * f64::EPSILON;
            for found in ends(&wheels(&inertias), &Metric::Euclidean).unwrap().chunks_exact(2) {
                let apart = [found[0] / size - 1e-3, found[1] / size - 1.0];
                assert!(apart.iter().all(|x| x.abs() <= bound), "{n}, {size:e}: {apart:?} of {bound:e}");
            }
        }
    }
}

/// What has no inertia is no unit of motion: an error, as one configuration at a time.
#[test]
fn a_metric_of_zero_is_refused() {
    let model = wheels(&[1.0, 0.0, 2.0]);
    let error = InputError::NotPositive { what: "diagonal of H", index: 1, value: 0.0 };
    let expected = BatchError::Configuration { index: 0, error: Error::from(error) };
    assert_eq!(ends(&model, &Metric::UnitDiagonal), Err(expected));
    let found = ends(&model, &Metric::Euclidean).unwrap();
    assert!(found.chunks_exact(2).all(|ends| ends == [0.0, 2.0]), "{found:?}");
}
