//! Equations in the axes of space against those in the axes of what carries the bodies.

use quote::quote;

use super::*;
use crate::lower::tests::{lowered, value};

#[test]
fn axes_leave_the_equations_what_they_are() {
    // A base that moves and turns, a telescope on it, a body whose place another rotation carries, a
    // particle, and forces that act through places, orientations and time.
    let model = lowered(
        quote!(coordinates = [x, yaw, pitch, reach, roll], inputs = [f]),
        quote! {
            impl Crane {
                fn base(&self, q: &Coordinates) -> Isometry3<f64> {
                    Isometry3::translation(q.x, 0.3, 0.2 * q.x * q.x) * Rotation3::from_axis_angle(&Vector3::z_axis(), q.yaw)
                }
                #[body(mass = 2.0, inertia = Matrix3::new(0.3, 0.02, 0.01, 0.02, 0.4, 0.03, 0.01, 0.03, 0.5))]
                fn boom(&self, q: &Coordinates) -> Isometry3<f64> {
                    self.base(q) * Translation3::new(0.1, 0.0, 0.4) * Rotation3::from_euler_angles(0.3, 0.0, 0.0)
                        * Rotation3::from_axis_angle(&Vector3::y_axis(), q.pitch)
                        * Translation3::new(0.5 + q.reach, 0.1, 0.0)
                }
                #[body(mass = self.m, inertia = [0.1, 0.2, 0.3])]
                fn hook(&self, q: &Coordinates) -> Isometry3<f64> {
                    let tip = self.boom(q) * Point3::new(0.2, 0.0, 0.1);
                    Isometry3::from_parts(Translation3::from(tip.coords), Rotation3::from_axis_angle(&Vector3::x_axis(), q.roll).into())
                }
                #[point(mass = 0.7)]
                fn weight(&self, q: &Coordinates) -> Point3<f64> {
                    self.hook(q) * Point3::new(0.0, -0.3, 0.2)
                }
                #[potential]
                fn pull(&self, q: &Coordinates, t: f64) -> f64 {
                    let apart = self.weight(q) - self.base(q) * Point3::new(1.0, 0.0, t);
                    9.81 * self.weight(q).z + 3.0 * self.boom(q).translation.z + 2.0 * apart.norm_squared()
                        + q.roll.cos()
                }
                #[force(at = boom)]
                fn wind(&self, q: &Coordinates, u: &Inputs) -> Vector3<f64> { Vector3::new(u.f, q.x, 0.4) }
            }
        },
    )
    .unwrap_or_else(|messages| panic!("{messages:#?}"));
    assert!(Motion::is_carried(&model));
    let [own, space] = [Axes::Own, Axes::Space].map(|axes| {
        let mut model = model.clone();
        let equations = Equations::in_axes(&mut model, axes, true);
        let Equations { momenta, momentum_rates, bias, applied, energy, inertia, .. } = &equations;
        let mut roots = equations.roots();
        roots.extend(momenta.iter().chain(momentum_rates).chain(bias).chain(applied));
        roots.extend([*energy, *inertia]);
        roots.extend(equations.power);
        let values: Vec<f64> = roots.iter().map(|&root| value(&model, root, |_| 1.3)).collect();
        values
    });
    assert_eq!(own.len(), space.len());
    for (own, space) in own.iter().zip(&space) {
        assert!((own - space).abs() <= 1e-13 * (1.0 + space.abs()), "{own} is not {space}");
    }
    assert!(own.iter().filter(|value| value.abs() > 1e-3).count() > 30);
}
