//! An arm of six joints, the motion that it shall make, and the torques of its motors, for the desk and for
//! the firmware.

use lagrangian::prelude::*;

/// An arm with the kinematics of a UR5, on a table.
#[derive(Clone, Copy, Debug)]
pub struct Arm<R> {
    /// The mass in the hand \[kg].
    pub payload: R,
}

#[lagrangian(coordinates = [joint: [6]], inputs = [torque: [6]], jacobians)]
impl<R: Real> Arm<R> {
    // Where each link is, and how it is turned.

    fn turn(&self, q: &Coordinates<R>, joint: usize) -> Rotation3<R> {
        // Base, shoulder, elbow, and three of the wrist; the arm points upwards at zero.
        let axis = if joint == 0 || joint == 4 { Vector3::z_axis() } else { Vector3::y_axis() };
        Rotation3::from_axis_angle(&axis, q.joint[joint])
    }

    fn base(&self, q: &Coordinates<R>) -> (Vector3<R>, Rotation3<R>) {
        (Vector3::new(0.0, 0.0, 0.089), self.turn(q, 0))
    }

    fn upper_arm(&self, q: &Coordinates<R>) -> (Vector3<R>, Rotation3<R>) {
        let (place, turn) = self.base(q);
        (place + turn * Vector3::new(0.0, 0.136, 0.0), turn * self.turn(q, 1))
    }

    fn forearm(&self, q: &Coordinates<R>) -> (Vector3<R>, Rotation3<R>) {
        let (place, turn) = self.upper_arm(q);
        (place + turn * Vector3::new(0.0, -0.12, 0.425), turn * self.turn(q, 2))
    }

    fn wrist_1(&self, q: &Coordinates<R>) -> (Vector3<R>, Rotation3<R>) {
        let (place, turn) = self.forearm(q);
        (place + turn * Vector3::new(0.0, 0.0, 0.392), turn * self.turn(q, 3))
    }

    fn wrist_2(&self, q: &Coordinates<R>) -> (Vector3<R>, Rotation3<R>) {
        let (place, turn) = self.wrist_1(q);
        (place + turn * Vector3::new(0.0, 0.093, 0.0), turn * self.turn(q, 4))
    }

    fn hand(&self, q: &Coordinates<R>) -> (Vector3<R>, Rotation3<R>) {
        let (place, turn) = self.wrist_2(q);
        (place + turn * Vector3::new(0.0, 0.0, 0.095), turn * self.turn(q, 5))
    }

    // The links by their centres of mass; the base only turns, and its moment is small.

    #[body(mass = 8.4, inertia = [0.227, 0.227, 0.015])]
    fn upper_link(&self, q: &Coordinates<R>) -> (Vector3<R>, Rotation3<R>) {
        let (place, turn) = self.upper_arm(q);
        (place + turn * Vector3::new(0.0, 0.0, 0.212), turn)
    }

    #[body(mass = 2.3, inertia = [0.031, 0.031, 0.004])]
    fn fore_link(&self, q: &Coordinates<R>) -> (Vector3<R>, Rotation3<R>) {
        let (place, turn) = self.forearm(q);
        (place + turn * Vector3::new(0.0, 0.0, 0.196), turn)
    }

    #[body(mass = 1.2, inertia = [0.003, 0.002, 0.003])]
    fn first_wrist_link(&self, q: &Coordinates<R>) -> (Vector3<R>, Rotation3<R>) {
        let (place, turn) = self.wrist_1(q);
        (place + turn * Vector3::new(0.0, 0.08, 0.0), turn)
    }

    #[body(mass = 1.2, inertia = [0.003, 0.003, 0.002])]
    fn second_wrist_link(&self, q: &Coordinates<R>) -> (Vector3<R>, Rotation3<R>) {
        let (place, turn) = self.wrist_2(q);
        (place + turn * Vector3::new(0.0, 0.0, 0.08), turn)
    }

    /// The point that the hand holds, with the payload.
    #[point(mass = self.payload)]
    pub fn tool(&self, q: &Coordinates<R>) -> Vector3<R> {
        let (place, turn) = self.hand(q);
        place + turn * Vector3::new(0.0, 0.14, 0.03)
    }

    /// The rotors turn a hundred times as fast as the joints.
    #[kinetic]
    fn rotors(&self, v: &Velocities<R>) -> R {
        v.joint.iter().map(|&rate| 0.05 * rate * rate).sum()
    }

    #[potential]
    fn gravity(&self, q: &Coordinates<R>) -> R {
        let links = self.upper_link(q).0.z * 8.4 + self.fore_link(q).0.z * 2.3;
        let wrist = (self.first_wrist_link(q).0.z + self.second_wrist_link(q).0.z) * 1.2;
        9.81 * (links + wrist + self.payload * self.tool(q).z)
    }

    #[dissipation]
    fn gears(&self, v: &Velocities<R>) -> R {
        v.joint.iter().map(|&rate| 0.5 * rate * rate).sum()
    }

    #[force]
    fn motors(&self, u: &Inputs<R>) -> [R; 6] {
        u.torque
    }
}

/// Angles, rates and angular accelerations that are wanted at one time.
#[derive(Clone, Copy, Debug)]
pub struct Wanted<R> {
    /// Angles and rates, with the time.
    pub state: State<R, 6>,
    /// Angular accelerations \[rad/s²].
    pub a: [R; 6],
}

/// How long the motion takes \[s].
pub const DURATION: f64 = 1.0;

/// The joint angles at the start and at the end \[rad].
pub const ENDS: [[f64; 6]; 2] = [[-0.6, 0.3, 1.2, -0.4, 0.5, 0.0], [0.9, -0.4, 1.9, 0.6, -0.7, 1.0]];

/// The motion from rest to rest with the least jerk, all joints in step.
pub fn wanted<R: Real>(t: R) -> Wanted<R> {
    let number = R::from_f64;
    let rate = number(1.0 / DURATION);
    let s = t * rate;
    let way = s * s * s * (number(10.0) - s * (number(15.0) - s * number(6.0)));
    let speed = s * s * (number(30.0) - s * (number(60.0) - s * number(30.0))) * rate;
    let acceleration = s * (number(60.0) - s * (number(180.0) - s * number(120.0))) * rate * rate;
    let distance: [R; 6] = core::array::from_fn(|i| number(ENDS[1][i] - ENDS[0][i]));
    let q = core::array::from_fn(|i| number(ENDS[0][i]) + distance[i] * way);
    let state = State { t, q, v: distance.map(|distance| distance * speed) };
    Wanted { state, a: distance.map(|distance| distance * acceleration) }
}

/// The rate at which the computed torque lets errors decay \[1/s].
pub const DECAY: f64 = 12.0;

/// Computed torque: the torques by which errors e obey e″ + 2λ e′ + λ² e = 0.
pub fn computed_torque<R: Real>(
    arm: &Arm<R>,
    state: &State<R, 6>,
    wanted: &Wanted<R>,
) -> Result<[R; 6], MotionError<R>> {
    let decay = R::from_f64(DECAY);
    let a = core::array::from_fn(|i| {
        let (behind, slower) = (wanted.state.q[i] - state.q[i], wanted.state.v[i] - state.v[i]);
        wanted.a[i] + decay * (slower + slower + decay * behind)
    });
    Ok(arm.inverse_dynamics(state, &a)?.total)
}

/// Gains of a regulator: torques by deviations of six angles and six rates.
pub type Gains<R> = SMatrix<R, 6, 12>;

/// The torques that the wanted motion needs in the middle of a sample of length `h` that begins at `t`.
pub fn needed<R: Real>(arm: &Arm<R>, t: R, h: R) -> Result<[R; 6], MotionError<R>> {
    let middle = wanted(t + h * R::from_f64(0.5));
    Ok(arm.inverse_dynamics(&middle.state, &middle.a)?.total)
}

/// The torques of a regulator for a sample: u = u* − K (x − x*).
pub fn regulated<R: Real>(
    arm: &Arm<R>,
    state: &State<R, 6>,
    h: R,
    gains: &Gains<R>,
) -> Result<[R; 6], MotionError<R>> {
    let (mut torque, aim) = (needed(arm, state.t, h)?, wanted(state.t).state);
    for ((x, aim), gains) in state.iter().zip(aim.iter()).zip(gains.column_iter()) {
        for (torque, &gain) in torque.iter_mut().zip(gains.iter()) {
            *torque -= gain * (x - aim);
        }
    }
    Ok(torque)
}
