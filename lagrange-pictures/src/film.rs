//! [`Film`]: points, rods, bodies and forces of a motion, as an SVG file that plays by itself.

use std::path::{Path, PathBuf};

use lagrange_runtime::{Constrained, Ordered, State, System};

use crate::error::PictureError;
use crate::file;
use crate::paper::{self, Kind, Shape, View};
use crate::place::{Place, Pose, Spot};
use crate::record::Record;

/// What moves. Places in the plane are seen from the front; places in space are seen from one side and a
/// little from above, unless [`Film::seen_from`] says otherwise.
///
/// Functions take the system and its coordinates by name, so that those of the description fit:
/// `record.film().trail(Pendulum::bob)`. A closure that reads a coordinate names the type,
/// `|p, q: &PendulumCoordinates| …`. What is added later is drawn over what was added before.
#[derive(Clone, Debug)]
pub struct Film<'r, S: System<N, K>, const N: usize, const K: usize = 0> {
    record: &'r Record<'r, S, N, K>,
    shapes: Vec<Shape>,
    view: View,
    slower: f64,
}

impl<'r, S, const N: usize, const K: usize> Film<'r, S, N, K>
where
    S: System<N, K>,
    S::Scalar: Ordered + Into<f64>,
{
    pub(crate) fn new(record: &'r Record<'r, S, N, K>) -> Self {
        Self { record, shapes: Vec::new(), view: View::default(), slower: 1.0 }
    }

    /// Shows the motion slower by this factor, or faster by one below one.
    #[must_use]
    pub fn slower(mut self, factor: f64) -> Self {
        self.slower = factor;
        self
    }

    /// Looks at space from this direction \[rad]: the azimuth from the x axis, the elevation above the
    /// horizon.
    #[must_use]
    pub fn seen_from(mut self, azimuth: f64, elevation: f64) -> Self {
        self.view = View { azimuth, elevation };
        self
    }

    /// A point.
    #[must_use]
    pub fn point<Q, P>(self, place: impl Fn(&S, &Q) -> P) -> Self
    where
        Q: From<[S::Scalar; N]>,
        P: Place,
    {
        self.shape(Kind::Point, |system, state| vec![place(system, &state.q.into()).spot()])
    }

    /// Rods from joint to joint.
    #[must_use]
    pub fn rods<Q, P>(self, joints: impl Fn(&S, &Q) -> P) -> Self
    where
        Q: From<[S::Scalar; N]>,
        P: IntoIterator<Item: Place>,
    {
        self.shape(Kind::Rods, |system, state| {
            joints(system, &state.q.into()).into_iter().map(Place::spot).collect()
        })
    }

    /// A body, by its outline in its own axes. The outline is closed: the first corner follows the last.
    #[must_use]
    pub fn body<Q, P>(self, pose: impl Fn(&S, &Q) -> P, outline: &[P::Corner]) -> Self
    where
        Q: From<[S::Scalar; N]>,
        P: Pose,
    {
        self.shape(Kind::Body, |system, state| {
            let pose = pose(system, &state.q.into());
            outline.iter().map(|&corner| pose.carry(corner)).collect()
        })
    }

    /// The path of a point, which grows as the point moves.
    #[must_use]
    pub fn trail<Q, P>(self, place: impl Fn(&S, &Q) -> P) -> Self
    where
        Q: From<[S::Scalar; N]>,
        P: Place,
    {
        self.shape(Kind::Trail, |system, state| vec![place(system, &state.q.into()).spot()])
    }

    /// A force as an arrow from where it acts. All arrows of the film have the same scale, and the longest
    /// has a fixed length. None is drawn where the force is zero.
    #[must_use]
    pub fn force<Q, P, F>(
        self,
        place: impl Fn(&S, &Q) -> P,
        force: impl Fn(&S, &State<S::Scalar, N>) -> F,
    ) -> Self
    where
        Q: From<[S::Scalar; N]>,
        P: Place,
        F: Place,
    {
        self.shape(Kind::Force, |system, state| {
            vec![place(system, &state.q.into()).spot(), force(system, state).spot()]
        })
    }

    /// The force of a constraint, contact or friction as an arrow, from the multipliers by name:
    /// `film.reaction(Ball::lowest, |_, _, found| [0.0, found.floor])`. A contact that is open has none.
    #[must_use]
    pub fn reaction<Q, P, F>(
        self,
        place: impl Fn(&S, &Q) -> P,
        force: impl Fn(&S, &State<S::Scalar, N>, &S::Reactions) -> F,
    ) -> Self
    where
        S: Constrained<N, K>,
        Q: From<[S::Scalar; N]>,
        P: Place,
        F: Place,
    {
        let constants = self.record.system().constants();
        let found = self.record.with_inputs().map(|(State { t, q, v }, inputs)| {
            self.record.system().reactions_at(&constants, *t, q, v, inputs)
        });
        let found: Vec<_> = found.collect();
        let mut found = found.iter();
        self.shape(Kind::Force, |system, state| {
            let force = found.next().map(|found| force(system, state, found).spot());
            std::iter::once(place(system, &state.q.into()).spot()).chain(force).collect()
        })
    }

    /// A line that does not move: a floor, a wall, a rail.
    #[must_use]
    pub fn ground(self, line: impl IntoIterator<Item: Place>) -> Self {
        let line: Vec<Spot> = line.into_iter().map(Place::spot).collect();
        self.shape(Kind::Ground, |_, _| line.clone())
    }

    fn shape(mut self, kind: Kind, mut spots: impl FnMut(&S, &State<S::Scalar, N>) -> Vec<Spot>) -> Self {
        let states = self.record.states().iter();
        let frames = states.map(|state| spots(self.record.system(), state)).collect();
        self.shapes.push(Shape { kind, frames });
        self
    }

    /// The picture as the text of an SVG file.
    ///
    /// # Errors
    /// [`PictureError::Empty`] without a shape or with less than two states, [`PictureError::NotFinite`],
    /// [`PictureError::UnequalTimes`], [`PictureError::ChangingShape`].
    pub fn svg(&self) -> Result<String, PictureError> {
        let times: Vec<f64> = self.record.states().iter().map(|state| state.t.into()).collect();
        paper::drawn(&times, self.slower, self.view, &self.shapes)
    }

    /// Writes the picture as an SVG file and returns where it is. Folders on the way are made.
    ///
    /// # Errors
    /// As [`Film::svg`], and [`PictureError::Io`].
    pub fn save(&self, path: impl AsRef<Path>) -> Result<PathBuf, PictureError> {
        file::write(path.as_ref(), &self.svg()?)
    }
}
