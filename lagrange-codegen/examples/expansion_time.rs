//! Time of one expansion with an engine built as macros are, without optimisation:
//! `cargo run -p lagrange-codegen --example expansion_time`.

use std::time::Instant;

use quote::quote;

fn main() {
    println!("{:>6} {:>12} {:>12}", "links", "expansion ms", "tokens kB");
    for count in [2_usize, 5, 10, 20, 50, 100] {
        let mut best = f64::INFINITY;
        let mut size = 0;
        for _ in 0..if count > 20 { 3 } else { 10 } {
            let args = quote!(coordinates = [theta: [#count]]);
            let item = quote! {
                impl Chain {
                    #[point(mass = self.mass)]
                    fn joints(&self, q: &Coordinates) -> [Vector2<f64>; #count] {
                        let mut joints = [Vector2::zeros(); #count];
                        let mut end = Vector2::zeros();
                        for i in 0..#count {
                            end += self.length * Vector2::new(q.theta[i].sin(), -q.theta[i].cos());
                            joints[i] = end;
                        }
                        joints
                    }

                    #[potential]
                    fn gravity(&self, q: &Coordinates) -> f64 {
                        self.joints(q).iter().map(|joint| self.mass * self.g * joint.y).sum()
                    }
                }
            };
            let start = Instant::now();
            let expansion = lagrange_codegen::expand(args, item, "::lagrangian");
            best = best.min(start.elapsed().as_secs_f64() * 1e3);
            size = expansion.to_string().len();
        }
        println!("{count:6} {best:12.1} {:12}", size / 1024);
    }
}
