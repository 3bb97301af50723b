//! Strongly connected parts of the graph of dependences.

/// The strongly connected parts of a graph, operands before their users (Tarjan, "Depth-first search and
/// linear graph algorithms", 1972). `edges` lists what each vertex depends on.
pub(super) fn connected(edges: &[Vec<u32>]) -> Vec<Vec<u32>> {
    const NEW: u32 = u32::MAX;
    let count = edges.len();
    let mut number = vec![NEW; count];
    let mut low = vec![0_u32; count];
    let mut on_stack = vec![false; count];
    let (mut stack, mut parts) = (Vec::new(), Vec::new());
    let mut next = 0;
    // The vertices that are being visited, with the numbers of edges followed. A recursive function would
    // overflow the stack, because a chain of instructions is as deep as the program is long.
    let mut walk: Vec<(u32, usize)> = Vec::new();
    for start in 0..count as u32 {
        if number[start as usize] != NEW {
            continue;
        }
        walk.push((start, 0));
        while let Some((vertex, followed)) = walk.last_mut() {
            let v = *vertex as usize;
            if *followed == 0 {
                (number[v], low[v]) = (next, next);
                next += 1;
                stack.push(*vertex);
                on_stack[v] = true;
            }
            if let Some(&to) = edges[v].get(*followed) {
                *followed += 1;
                if number[to as usize] == NEW {
                    walk.push((to, 0));
                } else if on_stack[to as usize] {
                    low[v] = low[v].min(number[to as usize]);
                }
                continue;
            }
            let vertex = *vertex;
            walk.pop();
            if let Some(&(parent, _)) = walk.last() {
                low[parent as usize] = low[parent as usize].min(low[v]);
            }
            if low[v] == number[v] {
                let from = stack.iter().rposition(|&other| other == vertex).unwrap_or(0);
                let part = stack.split_off(from);
                part.iter().for_each(|&member| on_stack[member as usize] = false);
                parts.push(part);
            }
        }
    }
    parts
}

#[cfg(test)]
mod tests {
    use super::connected;

    #[test]
    fn circles_are_one_part_and_operands_come_first() {
        // 0 → 1 → 2 → 1, 3 → 0 and 3 → 2.
        let mut parts = connected(&[vec![1], vec![2], vec![1], vec![0, 2]]);
        parts.iter_mut().for_each(|part| part.sort_unstable());
        assert_eq!(parts, [vec![1, 2], vec![0], vec![3]]);
    }
}
