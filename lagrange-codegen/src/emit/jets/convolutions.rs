//! The convolutions in the loop over the orders: their interior sums before an order, their factors after it.

use super::binding;
use super::order::Writer;
use super::wide::Wide;
use crate::collections::Lookup;
use crate::jets::Lane;

/// Up to this many lanes, the outermost terms of the interior sums are kept out of the tables: their sweep
/// would wait for the row that was just written, which more lanes hide behind each other.
pub(super) const EDGED: usize = 16;

/// So many sums are made anew in each order; more are overwritten, which saves setting them to zero.
const FRESH: usize = 32;

impl Writer<'_, '_> {
    /// The statement before everything else.
    pub(super) fn sweep(&self) -> String {
        match (self.wide, self.jets.lanes.is_empty()) {
            (_, true) => String::new(),
            (Some(wide), _) => {
                let sums = if wide.sums > FRESH { String::new() } else { self.sums(wide) };
                format!("{sums}tables.interior::<Products, _>(order, &mut inner);\n")
            }
            (None, _) => "let inner = tables.interior(order);\n".to_owned(),
        }
    }

    fn sums(&self, wide: &Wide) -> String {
        let (scalar, sums) = (&self.emission.scalar, wide.sums);
        format!("let mut inner: [{scalar}; {sums}] = [{}; {sums}];\n", self.zero())
    }

    /// The interior sums. Their outermost terms, with coefficients of order 1 and of the last order, are not
    /// in the tables: a sweep over a row that was just written would wait for it.
    pub(super) fn interiors(&mut self) {
        if let Some(wide) = self.wide {
            if wide.sums > FRESH {
                self.before.push_str(&self.sums(wide));
            }
            self.inner = wide.lanes.iter().map(|place| format!("inner[{place}]")).collect();
            return;
        }
        let scalar = &self.emission.scalar;
        let zero = self.zero();
        let mut edges: Lookup<crate::jets::Operand, (String, String)> = Lookup::default();
        let mut operands: Vec<crate::jets::Operand> = Vec::new();
        for lane in &self.jets.lanes {
            for operand in [lane.left, lane.right] {
                if edges.get(&operand).is_some() {
                    continue;
                }
                let label = &self.start.labels[operand.slot.index()];
                let ramp = if operand.ramp { "_ramp" } else { "" };
                let wish = |part: &str| Some(format!("{label}{ramp}_{part}")).filter(|_| !label.is_empty());
                let (first, last) = (self.names.claim(wish("first")), self.names.claim(wish("last")));
                self.before.push_str(&format!("let mut {first}: {scalar} = {zero};\n"));
                self.before.push_str(&format!("let mut {last}: {scalar} = {zero};\n"));
                edges.insert(operand, (first, last));
                operands.push(operand);
            }
        }
        for (place, lane) in self.jets.lanes.iter().enumerate() {
            let (Some(left), Some(right)) = (edges.get(&lane.left), edges.get(&lane.right)) else { continue };
            let text = if lane.left == lane.right {
                format!(
                    "lagrange::jets::squared::<ORDERS, _>(order, [{}, {}], inner[{place}])",
                    left.0, left.1
                )
            } else {
                format!(
                    "lagrange::jets::convolution::<ORDERS, _>(order, [{}, {}], [{}, {}], inner[{place}])",
                    left.0, left.1, right.0, right.1
                )
            };
            let name = self.names.claim(Some(format!("inner_{place}")));
            self.body.push_str(&binding(scalar, &name, &text));
            self.inner.push(name);
        }
        self.edges = operands
            .into_iter()
            .filter_map(|operand| {
                edges.get(&operand).map(|(first, last)| (operand, first.clone(), last.clone()))
            })
            .collect();
    }

    /// Puts the operands of all convolutions into the tables.
    pub(super) fn store(&mut self) {
        if self.jets.lanes.is_empty() {
            return;
        }
        let mut operands: Vec<crate::jets::Operand> = Vec::new();
        for lane in &self.jets.lanes {
            operands.extend([lane.left, lane.right]);
        }
        let mut values: Lookup<crate::jets::Operand, String> = Lookup::default();
        for operand in operands {
            if values.get(&operand).is_some() {
                continue;
            }
            let name = match &self.coefficients[operand.slot.index()] {
                none if none.is_empty() => self.zero(),
                name => name.clone(),
            };
            let value = if operand.ramp {
                let ramped = self.claim(operand.slot, "ramp");
                self.bind(&ramped, &format!("lagrange::jets::ramp(order, {name})"));
                ramped
            } else {
                name
            };
            values.insert(operand, value);
        }
        for (operand, first, last) in std::mem::take(&mut self.edges) {
            let value = values.get(&operand).cloned().unwrap_or_default();
            self.after.push_str(&format!(
                "{first} = lagrange::jets::first::<ORDERS, _>(order, {first}, {value});\n{last} = {value};\n"
            ));
        }
        if let Some(wide) = self.wide {
            self.body.push_str("if let ::core::option::Option::Some(row) = tables.row(order) {\n");
            for (place, factor) in &wide.factors {
                let value = values.get(factor).cloned().unwrap_or_default();
                self.body.push_str(&format!("row[{place}] = {value};\n"));
            }
            self.body.push_str("}\n");
            return;
        }
        self.body.push_str("if let ::core::option::Option::Some((left, right)) = tables.row(order) {\n");
        for (place, &Lane { left, right }) in self.jets.lanes.iter().enumerate() {
            let value = |operand| values.get(&operand).cloned().unwrap_or_default();
            self.body.push_str(&format!(
                "left[{place}] = {};\nright[{place}] = {};\n",
                value(left),
                value(right)
            ));
        }
        self.body.push_str("}\n");
    }
}
