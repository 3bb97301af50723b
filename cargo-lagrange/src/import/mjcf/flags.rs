//! What a file switches off: `<flag … ="disable"/>` in `<option>`.

use roxmltree::Node;

use super::super::robot::{Action, Robot};
use super::super::xml::{Reader, children};

/// The parts of a model that are off.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub(super) struct Off {
    pub(super) gravity: bool,
    pub(super) equality: bool,
    springs: bool,
    dampers: bool,
    friction: bool,
    limits: bool,
}

impl Off {
    /// Reads the flags. Of two that differ the last one holds.
    pub(super) fn read(reader: &mut Reader<'_>, root: Node<'_, '_>) -> Self {
        let mut off = Self::default();
        for flag in children(root, "option").flat_map(|option| children(option, "flag")) {
            let switch = |name: &str, parts: &mut [&mut bool]| {
                if let Some(value) = flag.attribute(name) {
                    parts.iter_mut().for_each(|part| **part = value == "disable");
                }
            };
            // Older versions have one flag for springs and dampers.
            switch("passive", &mut [&mut off.springs, &mut off.dampers]);
            switch("constraint", &mut [&mut off.equality, &mut off.friction, &mut off.limits]);
            switch("gravity", &mut [&mut off.gravity]);
            switch("spring", &mut [&mut off.springs]);
            switch("damper", &mut [&mut off.dampers]);
            switch("equality", &mut [&mut off.equality]);
            switch("frictionloss", &mut [&mut off.friction]);
            switch("limit", &mut [&mut off.limits]);
            if flag.attribute("actuation") == Some("disable") {
                let text =
                    "`actuation` is left out: actuators are inputs of the description; give them zeros";
                reader.warning(flag, text);
            }
        }
        off
    }

    /// Takes what is off out of the joints.
    pub(super) fn apply(self, robot: &mut Robot) {
        for Action { damping, stiffness, friction, limits, .. } in
            robot.joints.iter_mut().map(|joint| &mut joint.action)
        {
            let numbers = [(self.dampers, damping), (self.springs, stiffness), (self.friction, friction)];
            numbers.into_iter().filter(|(is_off, _)| *is_off).for_each(|(_, number)| *number = 0.0);
            *limits = limits.filter(|_| !self.limits);
        }
    }
}
