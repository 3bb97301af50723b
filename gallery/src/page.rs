//! [`Page`]: a system, its state, and what a browser asks of them.

use alloc::vec::Vec;

use lagrangian::State;

use crate::scene::Scene;
use crate::{Model, Point};

/// The memory of a module of WebAssembly.
#[derive(Debug)]
pub struct Page<M, const N: usize> {
    parameters: Vec<f64>,
    model: M,
    state: State<f64, N>,
    /// The time and the energy of the start, from which changes count.
    origin: [f64; 2],
    scene: Scene,
}

impl<M: Model<N>, const N: usize> Default for Page<M, N> {
    fn default() -> Self {
        let parameters: Vec<f64> = M::PARAMETERS.iter().map(|slider| slider.start).collect();
        let model = M::new(&parameters);
        let settings: Vec<f64> = M::SETTINGS.iter().map(|slider| slider.start).collect();
        let start = model.placed(&settings).unwrap_or(State { t: 0.0, q: [f64::NAN; N], v: [f64::NAN; N] });
        let mut page = Self { parameters, model, state: start, origin: [0.0; 2], scene: Scene::default() };
        page.restart(start);
        page
    }
}

impl<M: Model<N>, const N: usize> Page<M, N> {
    fn restart(&mut self, state: State<f64, N>) {
        self.state = state;
        self.origin = [state.t, self.energy()];
    }

    fn accept(&mut self, state: Option<State<f64, N>>) -> bool {
        let state = state.map(|state| state.at_time(self.state.t));
        state.map(|state| self.restart(state)).is_some()
    }

    /// Sets a parameter. Returns `false`, and changes nothing, where the system cannot have it in any state
    /// like the present one.
    pub fn set_parameter(&mut self, index: usize, value: f64) -> bool {
        let mut parameters = self.parameters.clone();
        let Some(parameter) = parameters.get_mut(index) else { return false };
        *parameter = value;
        let model = M::new(&parameters);
        let Some(state) = model.kept(&self.state) else { return false };
        (self.parameters, self.model) = (parameters, model);
        self.restart(state);
        true
    }

    /// Sets a parameter for a state that is set afterwards. Whether they go together [`Page::settle`] tells.
    pub fn assume_parameter(&mut self, index: usize, value: f64) {
        if let Some(parameter) = self.parameters.get_mut(index) {
            *parameter = value;
            self.model = M::new(&self.parameters);
        }
    }

    /// Sets one setting and leaves the others; `false` if there is no such state.
    pub fn set(&mut self, index: usize, value: f64) -> bool {
        let mut settings = self.model.settings(&self.state);
        let Some(setting) = settings.get_mut(index) else { return false };
        *setting = value;
        let state = self.model.placed(&settings);
        self.accept(state)
    }

    /// A setting.
    pub fn setting(&self, index: usize) -> f64 {
        self.model.settings(&self.state).get(index).copied().unwrap_or(f64::NAN)
    }

    /// Sets one of the 2 `N` numbers of the state: coordinates, then velocities.
    pub fn set_number(&mut self, index: usize, value: f64) {
        let mut state = self.state;
        let number = state.q.iter_mut().chain(&mut state.v).nth(index);
        if let Some(number) = number {
            *number = value;
            self.restart(state);
        }
    }

    /// One of the 2 `N` numbers of the state.
    pub fn number(&self, index: usize) -> f64 {
        self.state.iter().nth(index).unwrap_or(f64::NAN)
    }

    /// Takes a state that was set number by number and removes its rounding errors. Returns whether it is a
    /// state of the system.
    pub fn settle(&mut self) -> bool {
        let state = self.model.moved(&self.state, self.state.t).ok();
        self.accept(state)
    }

    /// Moves on; `false` if the motion ended.
    pub fn advance(&mut self, by: f64) -> bool {
        let moved = self.model.moved(&self.state, self.state.t + by);
        moved.map(|state| self.state = state).is_ok()
    }

    /// Time \[s].
    pub fn time(&self) -> f64 {
        self.state.t
    }

    /// Kinetic (0) or potential (1) energy \[J].
    pub fn part(&self, index: usize) -> f64 {
        self.model.energies(&self.state).get(index).copied().unwrap_or(f64::NAN)
    }

    fn energy(&self) -> f64 {
        self.model.energies(&self.state).iter().sum()
    }

    /// By how much the energy has changed since the state was set \[J].
    pub fn change(&self) -> f64 {
        self.energy() - self.origin[1]
    }

    /// A reaction.
    pub fn reaction(&self, index: usize) -> f64 {
        self.model.reactions(&self.state).get(index).copied().unwrap_or(f64::NAN)
    }

    /// Draws; returns how many numbers the drawing has.
    pub fn draw(&mut self) -> usize {
        self.scene.clear();
        self.model.draw(&self.state, &mut self.scene);
        self.scene.numbers().len()
    }

    /// A number of the drawing.
    pub fn drawn(&self, index: usize) -> f64 {
        self.scene.numbers().get(index).copied().unwrap_or(f64::NAN)
    }

    /// How many handles there are.
    pub fn handles(&self) -> usize {
        self.model.handles(&self.state).len()
    }

    /// A number of the place of a handle.
    pub fn handle(&self, index: usize, axis: usize) -> f64 {
        let handles: Vec<Point> = self.model.handles(&self.state);
        handles.get(index).and_then(|place| place.get(axis)).copied().unwrap_or(f64::NAN)
    }

    /// Drags a handle to a place; `false` if it cannot be there.
    pub fn drag(&mut self, index: usize, to: Point) -> bool {
        let state = self.model.dragged(&self.state, index, to);
        self.accept(state)
    }
}
