//! Reactions that limit friction: the force of one constraint, or the common size of several forces.

use super::advice::{counted, valid_indices};
use super::interpreter::Interpreter;
use crate::diagnostics::catalogue;
use crate::expr::{Node, NodeId, Variable};
use crate::kinematics::acting::{Acting, acting};
use crate::model::{Constraint, ConstraintKind, Load, Model, Normal, component_of_one};
use crate::syntax::body::{Expr, Name, Word};
use crate::syntax::item::{self, Function, RoleKind};

/// The limit of a friction.
#[derive(Clone, Copy, Debug)]
pub(super) struct Limit {
    pub normal: Normal,
    /// The Cartesian size of the force that a unit multiplier exerts, if its form tells.
    pub size: Option<NodeId>,
}

/// The forces of constraints and gaps on each particle and body.
pub(super) struct Actions {
    rows: Vec<Constraint>,
    /// The number of constraints, which come before gaps.
    held: usize,
    acting: Vec<Vec<Acting>>,
    /// The names of constraints that are solved for a coordinate, with their actions. Their forces have no
    /// multiplier.
    eliminated: Vec<(String, Vec<Acting>)>,
    /// Whether all constraints and places were read. After a mistake something may be missing here that the
    /// user has written.
    are_read: bool,
}

impl Actions {
    pub fn of(model: &mut Model, are_read: bool) -> Actions {
        let gaps = model.contacts.iter().map(|contact| &contact.constraint);
        let rows: Vec<Constraint> = model.constraints.iter().chain(gaps).cloned().collect();
        let solved: Vec<Constraint> = model.eliminations.iter().map(|one| one.constraint.clone()).collect();
        let eliminated = solved.iter().map(Constraint::written).zip(acting(model, &solved)).collect();
        let acting = acting(model, &rows);
        Actions { rows, held: model.constraints.len(), acting, eliminated, are_read }
    }

    /// The force of a row on a place, if there is any.
    fn at(&self, model: &Model, row: usize, place: usize) -> Option<&Acting> {
        self.acting[row].get(place).filter(|acting| acting.is_any(&model.graph))
    }

    /// An eliminated constraint that acts on a place, by its name.
    fn eliminated_at(&self, model: &Model, place: usize) -> Option<&str> {
        let acts = |own: &[Acting]| own.get(place).is_some_and(|acting| acting.is_any(&model.graph));
        self.eliminated.iter().find(|(_, own)| acts(own)).map(|(name, _)| name.as_str())
    }

    /// Whether a row is a holonomic constraint.
    fn presses(&self, row: usize) -> bool {
        row < self.held && self.rows[row].kind == ConstraintKind::Holonomic
    }
}

impl<'a> Interpreter<'a> {
    /// The reactions that `normal = …` names, one for each friction; `None` after a reported mistake.
    pub(super) fn limits(
        &mut self,
        function: &'a Function,
        normal: &'a item::Normal,
        count: Option<usize>,
        actions: &Actions,
    ) -> Option<Vec<Limit>> {
        let wanted = count.unwrap_or(1);
        let (word, element) = match normal {
            item::Normal::One(word, element) => (word, element.as_ref()),
            item::Normal::Together(names, origin) => {
                let mut rows = Vec::new();
                for (word, element) in names {
                    for row in self.rows_named(word, element.as_ref(), actions)? {
                        if !actions.presses(row) {
                            self.report(word.origin, catalogue::friction_with_gap(&word.name));
                            return None;
                        }
                        if rows.contains(&row) {
                            let name = actions.rows[row].written();
                            self.report(word.origin, catalogue::friction_named_twice(name));
                            return None;
                        }
                        rows.push(row);
                    }
                }
                if rows.is_empty() {
                    self.report(*origin, catalogue::friction_without_normal());
                    return None;
                }
                let places = 0..self.model.places.len();
                let known = |row: usize, place: usize| {
                    actions.at(&self.model, row, place).is_some_and(|acting| acting.is_whole)
                };
                let common = places.into_iter().find(|&place| rows.iter().all(|&row| known(row, place)));
                let Some(place) = common else {
                    if actions.are_read {
                        self.report(*origin, catalogue::friction_apart());
                    }
                    return None;
                };
                let limit = self.together(function, &rows, place, actions);
                return Some(vec![limit; wanted]);
            }
        };
        let is_place = |function: &&Function| {
            let kind = function.role.as_ref().map(|role| &role.kind);
            function.name == word.name && matches!(kind, Some(RoleKind::Point { .. } | RoleKind::Body { .. }))
        };
        if self.item.functions.iter().any(|function| is_place(&function)) {
            let limit = self.reaction_on(function, word, element, actions)?;
            return Some(vec![limit; wanted]);
        }
        let rows = self.rows_named(word, element, actions)?;
        let rows = if let [row] = rows.as_slice() { vec![*row; wanted] } else { rows };
        if rows.len() != wanted {
            let (have, want) = (counted(wanted, "friction"), counted(rows.len(), "reaction"));
            self.report(word.origin, catalogue::friction_count(&function.name, have, want));
            return None;
        }
        rows.into_iter().map(|row| self.single(word, row, actions)).collect()
    }

    /// The constraints and gaps with a name.
    fn rows_named(
        &mut self,
        word: &'a Word,
        element: Option<&'a Expr>,
        actions: &Actions,
    ) -> Option<Vec<usize>> {
        let rows: Vec<usize> = (0..actions.rows.len())
            .filter(|&row| actions.presses(row) || row >= actions.held)
            .filter(|&row| *actions.rows[row].name == *word.name)
            .collect();
        if rows.is_empty() {
            let functions = self.item.functions.iter().filter(|other| has_reaction(other));
            let names: Vec<Name> = functions.map(|function| function.name.clone()).collect();
            // A constraint without a row has had its message.
            if !names.contains(&word.name) {
                let near = self.near(&word.name, &names);
                self.report(word.origin, catalogue::friction_on_unknown(&word.name, near));
            }
            return None;
        }
        let Some(element) = element else { return Some(rows) };
        let index = self.length(element)?;
        match rows.iter().find(|&&row| actions.rows[row].index == Some(index)) {
            Some(&row) => Some(vec![row]),
            None => {
                let valid = valid_indices(rows.len());
                self.report(element.origin, catalogue::index_out_of_range(index, valid));
                None
            }
        }
    }

    /// The reaction on a particle or a body: all forces of constraints there together.
    fn reaction_on(
        &mut self,
        function: &'a Function,
        word: &'a Word,
        element: Option<&'a Expr>,
        actions: &Actions,
    ) -> Option<Limit> {
        let index = match element {
            Some(element) => Some(self.length(element)?),
            None => None,
        };
        let places = &self.model.places;
        let place = places.iter().position(|place| *place.name == *word.name && place.index == index);
        let Some(place) = place else {
            if actions.are_read {
                self.report(word.origin, catalogue::friction_on_free_place(&word.name));
            }
            return None;
        };
        let acts = |&row: &usize| actions.at(&self.model, row, place).is_some();
        let found: Vec<usize> = (0..actions.rows.len()).filter(acts).collect();
        for &row in &found {
            let name = actions.rows[row].written();
            let is_whole = actions.at(&self.model, row, place).is_some_and(|acting| acting.is_whole);
            let fault = match (actions.presses(row), is_whole) {
                (false, _) => catalogue::friction_beside(name, &word.name),
                (true, false) => catalogue::friction_by_form(name, &word.name),
                (true, true) => continue,
            };
            self.report(word.origin, fault);
            return None;
        }
        if found.is_empty() {
            if actions.are_read {
                self.report(word.origin, catalogue::friction_on_free_place(&word.name));
            }
            return None;
        }
        if let Some(name) = actions.eliminated_at(&self.model, place) {
            self.report(word.origin, catalogue::friction_beside(name, &word.name));
            return None;
        }
        Some(self.together(function, &found, place, actions))
    }

    /// The size of the force that constraints exert together on a place.
    fn together(&mut self, function: &Function, rows: &[usize], place: usize, actions: &Actions) -> Limit {
        if let [row] = *rows {
            let size = actions.acting[row][place].size(&mut self.model.graph);
            return Limit { normal: Normal::Row(row), size: Some(size) };
        }
        let graph = &self.model.graph;
        let component = |i: usize| -> Vec<(usize, NodeId)> {
            let factors = rows.iter().map(|&row| (row, actions.acting[row][place].force[i]));
            factors.filter(|&(_, factor)| !graph.is_zero(factor)).collect()
        };
        let force: Vec<_> = (0..self.model.places[place].position.len())
            .map(component)
            .filter(|terms| !terms.is_empty())
            .collect();
        self.model.loads.push(Load { friction: function.name.to_string(), force, origin: function.origin });
        Limit { normal: Normal::Load(self.model.loads.len() - 1), size: None }
    }

    /// The reaction of a row. Its Cartesian size is that of its force on the first place where that is known:
    /// a reaction between two places has the same size on both. A row that acts on no place, such as a gap
    /// between coordinates of a kinetic energy, is documented to be a length, so that its multiplier is the
    /// force itself. `None` after a report where a row acts on places, and its form does not tell how.
    fn single(&mut self, word: &Word, row: usize, actions: &Actions) -> Option<Limit> {
        let own = &actions.acting[row];
        let normal = Normal::Row(row);
        let hidden = own.iter().position(|acting| !acting.is_whole);
        let tells = |&place: &usize| {
            let acting = &own[place];
            acting.is_whole
                && acting.is_any(&self.model.graph)
                && (hidden.is_none() || self.names_all_of(&actions.rows[row], place))
        };
        match ((0..own.len()).find(tells), hidden) {
            (Some(place), _) => Some(Limit { normal, size: Some(own[place].size(&mut self.model.graph)) }),
            (None, Some(place)) => {
                let name = actions.rows[row].written();
                let place = &self.model.places[place].name;
                self.report(word.origin, catalogue::friction_by_form(name, place));
                None
            }
            (None, None) => Some(Limit { normal, size: None }),
        }
    }

    /// Whether a row names the whole position of a place: by its function, or in coordinates that are all
    /// components of it. Of a cart on a rail, a coordinate alone gives one component of a force.
    fn names_all_of(&self, row: &Constraint, place: usize) -> bool {
        let Model { graph, places, .. } = &self.model;
        let place = &places[place];
        let by_function = || graph.cone(row.through).iter().any(|node| place.variables.contains(node));
        let is_coordinate = |x: NodeId| matches!(graph.node(x), Node::Variable(Variable::Coordinate(_)));
        let stands = |&x: &NodeId| is_coordinate(x) && component_of_one(places, x).is_some();
        place.position.iter().all(stands) || by_function()
    }
}

fn has_reaction(function: &Function) -> bool {
    matches!(function.meant(), Some(RoleKind::Unilateral { .. } | RoleKind::Holonomic { eliminate: None }))
}
