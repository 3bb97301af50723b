//! Random changes of descriptions, as tokens: delete, duplicate, swap, replace, insert, nest.

use proc_macro2::{Delimiter, Group, TokenStream, TokenTree};

/// Xorshift numbers (G. Marsaglia, Xorshift RNGs, J. Stat. Softw. 8, 2003).
pub struct Random(u64);

impl Random {
    /// The sequence of a seed.
    pub fn new(seed: u64) -> Random {
        // Seeds in a row are far apart.
        Random(seed.wrapping_mul(0x9E37_79B9_7F4A_7C15) | 1)
    }

    /// A number below a bound above 0.
    pub fn below(&mut self, bound: usize) -> usize {
        self.0 ^= self.0 << 13;
        self.0 ^= self.0 >> 7;
        self.0 ^= self.0 << 17;
        (self.0 >> 11) as usize % bound
    }
}

/// Descriptions that are accepted: the struct, the arguments of the attribute, the impl block.
pub const ACCEPTED: [(&str, &str, &str); 6] = [
    (
        "pub struct Arm { pub m: [f64; 2], pub l: [f64; 2], pub g: f64 }",
        "coordinates = [theta: [2]]",
        "impl Arm {
            const HALF: f64 = 0.5; const N: usize = 2;
            #[point(mass = self.m[0])] fn upper(&self, q: &Coordinates) -> Vector2<f64> {
                self.l[0] * Vector2::new(q.theta[0].sin(), -q.theta[0].cos()) }
            #[point(mass = self.m[1])] fn lower(&self, q: &Coordinates) -> Vector2<f64> {
                self.upper(q) + self.l[1] * Vector2::new(q.theta[1].sin(), -q.theta[1].cos()) }
            #[potential] fn gravity(&self, q: &Coordinates) -> f64 {
                let mut sum = 0.0;
                for (i, p) in [self.upper(q), self.lower(q)].iter().enumerate() { sum += self.m[i] * self.g * p.y; }
                sum + Self::HALF * if Self::N == 2 { 1.0 } else { 2.0 } }
        }",
    ),
    (
        "pub struct Cart<R> { pub m: R, pub p: R, pub l: R, pub g: R, pub d: R }",
        "coordinates = [x, theta], inputs = [motor], jacobians",
        "impl<R: Real> Cart<R> {
            #[point(mass = self.m)] fn cart(&self, q: &Coordinates<R>) -> Vector2<R> { Vector2::new(q.x, R::zero()) }
            #[point(mass = self.p * 2.0)] fn tip(&self, q: &Coordinates<R>) -> Vector2<R> {
                let (s, c) = q.theta.sin_cos(); self.cart(q) + Vector2::new(s, c) * self.l }
            #[potential] fn gravity(&self, q: &Coordinates<R>) -> R { self.p * self.g * self.tip(q).y }
            #[dissipation] fn bearing(&self, v: &Velocities<R>) -> R { 0.5 * self.d * v.theta.powi(2) }
            #[force(on = x)] fn motor(&self, u: &Inputs<R>, t: R) -> R { u.motor + t.sin() }
        }",
    ),
    (
        "pub struct Rod { pub m: f64, pub l: f64, pub g: f64 }",
        "coordinates = [x, y, z], analysis",
        "impl Rod {
            #[point(mass = self.m)] fn bob(&self, q: &Coordinates) -> Point3<f64> { Point3::new(q.x, q.y, q.z) }
            #[potential] fn weight(&self, q: &Coordinates) -> f64 { self.m * self.g * self.bob(q).z }
            #[holonomic] fn rod(&self, q: &Coordinates) -> f64 { self.bob(q).coords.norm_squared() - self.l.powi(2) }
        }",
    ),
    (
        "pub struct Top { pub m: f64, pub i: [f64; 3], pub l: f64, pub g: f64 }",
        "coordinates = [phi, theta, psi]",
        "impl Top {
            #[body(mass = self.m, inertia = self.i)] fn top(&self, q: &Coordinates) -> Isometry3<f64> {
                let turn = UnitQuaternion::from_axis_angle(&Vector3::z_axis(), q.phi)
                    * UnitQuaternion::from_axis_angle(&Vector3::x_axis(), q.theta)
                    * UnitQuaternion::from_axis_angle(&Vector3::z_axis(), q.psi);
                Isometry3::from_parts(Translation3::from(turn * (self.l * Vector3::z())), turn) }
            #[potential] fn weight(&self, q: &Coordinates) -> f64 { self.m * self.g * self.l * q.theta.cos() }
        }",
    ),
    (
        "pub struct Row { pub m: f64, pub k: f64 }",
        "coordinates = [x: [4]], sensitivities = [self.k], allow(no_effect)",
        "impl Row {
            fn stretch(&self, q: &Coordinates, i: usize) -> f64 {
                match i { 0 => q.x[0], 1 | 2 => q.x[i] - q.x[i - 1], _ => { let [.., last] = q.x; last - q.x[2] } } }
            #[kinetic] fn motion(&self, v: &Velocities) -> f64 { v.x.iter().map(|v| 0.5 * self.m * v * v).sum() }
            #[potential] fn springs(&self, q: &Coordinates) -> f64 {
                (0..4).map(|i| self.stretch(q, i)).fold(0.0, |sum, s| sum + 0.5 * self.k * s.powi(2)) }
        }",
    ),
    (
        "pub struct Skate { pub m: f64, pub j: f64 }",
        "coordinates = [x, y, a]",
        "impl Skate {
            #[body(mass = self.m, inertia = self.j)] fn blade(&self, q: &Coordinates) -> (Vector2<f64>, f64) {
                (vector![q.x, q.y], q.a) }
            #[nonholonomic] fn edge(&self, q: &Coordinates, v: &Velocities) -> f64 { v.x * q.a.sin() - v.y * q.a.cos() }
            #[force(at = blade)] fn push(&self, t: f64) -> Vector2<f64> { Vector2::new(std::f64::consts::PI, t as f64) }
        }",
    ),
];

/// Whether a description was accepted: its expansion has neither a message nor a constant that refuses a
/// program.
pub fn is_accepted(expansion: &str) -> bool {
    !expansion.contains("compile_error") && !expansion.contains("REFUSED")
}

/// The tokens that replace others.
const VOCABULARY: [&str; 110] = [
    "+",
    "-",
    "*",
    "/",
    "%",
    "=",
    "==",
    "<",
    ">=",
    "&&",
    "||",
    "!",
    "&",
    "^",
    ".",
    "..",
    "..=",
    "=>",
    "->",
    "::",
    ":",
    ";",
    ",",
    "#",
    "?",
    "@",
    "|",
    "_",
    "0",
    "1",
    "2",
    "-1",
    "1.0",
    "0.5",
    "1e300",
    "1e-300",
    "1e999",
    "255u8",
    "300",
    "2.5f32",
    "true",
    "false",
    "\"a\"",
    "'c'",
    "'a",
    "self",
    "Self",
    "q",
    "v",
    "t",
    "u",
    "x",
    "y",
    "theta",
    "i",
    "q.x",
    "v.x",
    "self.m",
    "self",
    "fn",
    "let",
    "mut",
    "const",
    "static",
    "for",
    "in",
    "if",
    "else",
    "match",
    "return",
    "break",
    "continue",
    "loop",
    "while",
    "as",
    "move",
    "impl",
    "where",
    "use",
    "f64",
    "f32",
    "u8",
    "i32",
    "usize",
    "bool",
    "R",
    "Vector2",
    "Vector3",
    "Matrix3",
    "Rotation3",
    "Coordinates",
    "Velocities",
    "Inputs",
    "point",
    "potential",
    "kinetic",
    "force",
    "holonomic",
    "mass",
    "on",
    "at",
    "eliminate",
    "powi",
    "sqrt",
    "sum",
    "map",
    "iter",
    "new",
    "N",
    "PI",
];

/// A description after some changes.
pub fn mutated(tokens: TokenStream, random: &mut Random) -> TokenStream {
    let mut tokens = tokens;
    for _ in 0..1 + random.below(3) {
        let count = count(&tokens);
        if count > 0 {
            let mut place = random.below(count);
            tokens = change(tokens, &mut place, random);
        }
    }
    tokens
}

fn count(tokens: &TokenStream) -> usize {
    let inner = |tree: TokenTree| match tree {
        TokenTree::Group(group) => 1 + count(&group.stream()),
        _ => 1,
    };
    tokens.clone().into_iter().map(inner).sum()
}

/// Changes the token at a place, counted through all groups.
fn change(tokens: TokenStream, place: &mut usize, random: &mut Random) -> TokenStream {
    let mut out: Vec<TokenTree> = Vec::new();
    let mut trees = tokens.into_iter();
    while let Some(tree) = trees.next() {
        if *place == 0 {
            *place = usize::MAX;
            match random.below(7) {
                0 => {}
                1 => out.extend([tree.clone(), tree]),
                2 => {
                    out.extend(trees.next());
                    out.push(tree);
                }
                3 | 4 => out.extend(word(random)),
                5 => {
                    out.extend(word(random));
                    out.push(tree);
                }
                _ => {
                    let delimiters =
                        [Delimiter::Parenthesis, Delimiter::Bracket, Delimiter::Brace, Delimiter::None];
                    let delimiter = delimiters[random.below(delimiters.len())];
                    out.push(Group::new(delimiter, tree.into()).into());
                }
            }
            continue;
        }
        if *place != usize::MAX {
            *place -= 1;
        }
        match tree {
            TokenTree::Group(group) if *place != usize::MAX => {
                let inside = change(group.stream(), place, random);
                out.push(Group::new(group.delimiter(), inside).into());
            }
            other => out.push(other),
        }
    }
    out.into_iter().collect()
}

/// A token of the vocabulary.
pub fn word(random: &mut Random) -> TokenStream {
    VOCABULARY[random.below(VOCABULARY.len())].parse().unwrap_or_default()
}
