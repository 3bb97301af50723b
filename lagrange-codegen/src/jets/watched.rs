//! What a search for the zeros of a function has to know beside its values.

use super::steep::{Hidden, hidden_beside, is_known};
use crate::expr::{Graph, Node, NodeId, Unary};

/// What samples of a function beside the equations may miss.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Watched {
    /// What functions in it depend on that can be narrow; `None` without such functions.
    pub hidden: Option<Hidden>,
    /// Functions at the zeros of which it has a kink or a jump.
    pub kinks: Vec<NodeId>,
}

impl Watched {
    /// That of a function.
    pub fn of(graph: &mut Graph, function: NodeId) -> Self {
        let mut kinks = Vec::new();
        for id in graph.cone([function]) {
            if let Node::Unary(
                Unary::Abs | Unary::Signum | Unary::PositivePart | Unary::Step | Unary::Below,
                argument,
            ) = *graph.node(id)
                && is_known(graph, argument)
                && !kinks.contains(&argument)
            {
                kinks.push(argument);
            }
        }
        Self { hidden: hidden_beside(graph, &[function], &[]), kinks }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::expr::Variable;

    #[test]
    fn each_switching_function_is_watched_once() {
        let mut graph = Graph::default();
        let [x, y] = [0, 1].map(|i| graph.variable(Variable::Coordinate(i)));
        let fixed = graph.variable(Variable::Parameter(0));
        let [size, part] = [Unary::Abs, Unary::PositivePart].map(|kink| graph.unary(kink, x));
        let [other, bound] = [y, fixed].map(|of| graph.unary(Unary::Step, of));
        let mut sum = graph.add(size, part);
        for more in [other, bound] {
            sum = graph.add(sum, more);
        }
        assert_eq!(Watched::of(&mut graph, sum).kinks, [x, y]);
        assert_eq!(Watched::of(&mut graph, fixed), Watched::default());
    }
}
