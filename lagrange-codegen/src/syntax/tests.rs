//! Parsing, the emitted impl block, and recovery.

use proc_macro2::TokenStream;
use quote::quote;

use super::types::TypeKind;
use super::{Group, Incomplete, Item, Scalar, parse, recover};
use crate::diagnostics::Diagnostics;

fn parsed(args: TokenStream, item: TokenStream) -> Item {
    let mut diagnostics = Diagnostics::new();
    let item = parse(args, item, "::lagrangian", &mut diagnostics);
    let messages: Vec<&str> = diagnostics.messages().collect();
    assert!(messages.is_empty(), "{messages:?}");
    item.expect("an item")
}

fn flat(tokens: TokenStream) -> String {
    tokens.to_string().split_whitespace().collect::<Vec<_>>().join(" ")
}

#[test]
fn numbers_of_the_type_are_a_part_of_the_name() {
    for (ty, expected) in
        [(quote!(Chain), "Chain"), (quote!(Chain<3, f64>), "Chain3"), (quote!(Chain<-3>), "ChainMinus3")]
    {
        let item = parsed(
            quote!(coordinates = [x]),
            quote!(impl #ty { #[kinetic] fn energy(&self, v: &Velocities) -> f64 { v.x * v.x } }),
        );
        assert_eq!(item.name, expected);
    }
}

#[test]
fn the_attribute_is_read() {
    let item = parsed(
        quote! {
            coordinates = [x, höhe: [Self::N + 1], r#type], inputs = [motor], crate = my::own,
            allow(unused_input)
        },
        quote! {
            impl<'a, T> System<'a, T> {
                const N: usize = 2;
                #[kinetic]
                fn energy(&self, v: &Velocities) -> f32 { 0.5 * v.x * v.x }
            }
        },
    );
    let groups: Vec<(String, Option<usize>)> =
        item.coordinates.iter().map(|group| (group.name().to_string(), group.length)).collect();
    assert_eq!(groups, [("x".into(), None), ("höhe".into(), Some(3)), ("type".into(), None)]);
    assert_eq!(item.inputs[0].name().as_ref(), "motor");
    assert_eq!(item.scalar, Scalar::F32);
    assert_eq!(item.name, "System");
    let path = &item.crate_path;
    assert_eq!(flat(quote!(#path)), "my :: own");
    assert!(item.allows("unused_input") && !item.allows("no_effect"));
}

#[test]
fn a_concrete_block_stays_as_written() {
    let item = parsed(
        quote!(coordinates = [x]),
        quote! {
            impl Spring {
                /// Stiffness.
                const K: f64 = 2.0;
                /// Energy.
                #[potential]
                #[inline]
                pub fn energy(&self, q: &Coordinates) -> f64 { let Coordinates { x } = q; 0.5 * Self::K * x.powi(2) }
                #[point(mass = self.total())]
                fn bob(&self, q: &Coordinates) -> f64 { q.x }
                fn total(&self) -> f64 { 1.0 }
            }
        },
    );
    assert_eq!(
        flat(item.cleaned),
        flat(quote! {
            impl Spring {
                /// Stiffness.
                #[allow(dead_code)]
                const K: f64 = 2.0;
                /// Energy.
                #[inline]
                #[allow(dead_code)]
                pub fn energy(&self, q: &SpringCoordinates) -> f64 {
                    let SpringCoordinates { x } = q;
                    0.5 * Self::K * x.powi(2)
                }
                #[allow(dead_code)]
                fn bob(&self, q: &SpringCoordinates) -> f64 { q.x }
                #[allow(dead_code)]
                fn total(&self) -> f64 { 1.0 }
            }
        })
    );
}

#[test]
fn a_generic_block_takes_its_literals_from_the_scalar() {
    let item = parsed(
        quote!(coordinates = [x]),
        quote! {
            impl<R: Real> Spring<R> {
                const K: f64 = 2.0;
                #[potential]
                fn energy(&self, q: &Coordinates) -> R {
                    const HALF: f64 = 0.5;
                    let p = vector![q.x, 1.5];
                    let r = Rotation2::new(q.x);
                    R::from_f64(Self::K) * 0.5 * (r * p).norm() + R::from_f64(0.25) * q.x.powi(2)
                }
                fn in_doubles(x: f64) -> f64 { 2.0 * x }
            }
        },
    );
    let half = quote!(<R as ::lagrangian::Real>::from_f64(0.5));
    let literal = quote!(<R as ::lagrangian::Real>::from_f64(1.5));
    assert_eq!(
        flat(item.cleaned),
        flat(quote! {
            impl<R: Real> Spring<R> {
                #[allow(dead_code)]
                const K: f64 = 2.0;
                #[allow(dead_code)]
                fn energy(&self, q: &SpringCoordinates<R>) -> R {
                    const HALF: f64 = 0.5;
                    let p = vector![q.x, #literal];
                    let r = ::lagrangian::__private::algebra::rotation2(q.x);
                    R::from_f64(Self::K) * #half * ::lagrangian::__private::algebra::norm(&((r * p)),)
                        + R::from_f64(0.25) * q.x.powi(2)
                }
                fn in_doubles(x: f64) -> f64 { 2.0 * x }
            }
        })
    );
}

#[test]
fn single_precision_is_named_in_signatures() {
    let item = parsed(
        quote!(coordinates = [x]),
        quote! { impl S { #[point(mass = 1.0)] fn bob(&self, q: &Coordinates) -> f32 { q.x } } },
    );
    assert_eq!(item.scalar, Scalar::F32);
    assert!(flat(item.cleaned).contains("q : & SCoordinates < f32 >"));
}

#[test]
fn recovery_keeps_signatures_and_hides_bodies() {
    let recovered = recover(quote! {
        impl Arm {
            #[potental]
            fn energy(&self, q: &Coordinates) -> f64 { q.unknown }
            fn helper() -> impl Iterator<Item = f64> { [1.0].into_iter() }
        }
    });
    let text = flat(recovered.clone());
    assert!(syn::parse2::<syn::File>(recovered).is_ok());
    let hidden = "# [cfg (rust_analyzer)] { q . unknown } # [cfg (not (rust_analyzer))] { loop { } }";
    assert!(
        text.contains(&format!("fn energy (& self , q : & ArmCoordinates) -> f64 {{ {hidden} }}")),
        "{text}"
    );
    assert!(text.contains("[1.0] . into_iter ()"), "{text}");
    assert!(!text.contains("potental"));
}

#[test]
fn what_is_unfinished_is_read_item_by_item() {
    let block = quote! {
        impl Arm {
            const N: usize = 2
            #[potential] fn energy(&self, q: &Coordinates) -> f64 { q. }
            stray #[point(mass = 1.0)] fn foot(&self, q: ) -> Vector2<f64> { q.x }
            fn helper(&self, f: fn(f64) -> f64) -> SVector<f64, { Self::N }> { loop {} }
            fn open(&self) -> f64
            pub fn last() {}
        }
    };
    let item = parse(quote!(coordinates = [x]), block, "::lagrangian", &mut Diagnostics::new());
    let item = item.expect("the header is there");
    assert!(matches!(item.incomplete, Some(Incomplete::Form(_))));
    let names: Vec<&str> = item.functions.iter().map(|function| &*function.name).collect();
    assert_eq!(names, ["energy", "foot", "helper", "open", "last"]);
    let roles: Vec<bool> = item.functions.iter().map(|function| function.role.is_some()).collect();
    assert_eq!(roles, [true, true, false, false, false]);
    assert!(matches!(item.functions[1].output.as_ref().map(|ty| &ty.kind), Some(TypeKind::Vector(_))));
}

#[test]
fn declarations_outlive_arguments_that_do_not_parse() {
    let read = |args: TokenStream| {
        let mut diagnostics = Diagnostics::new();
        let item = parse(args, quote!(impl Arm {}), "::lagrangian", &mut diagnostics).expect("an item");
        assert_eq!(diagnostics.messages().count(), 1);
        assert!(matches!(item.incomplete, Some(Incomplete::Declarations)));
        let named = |groups: &[Group]| groups.iter().map(|group| group.ident.to_string()).collect::<Vec<_>>();
        (named(&item.coordinates), named(&item.inputs), item.jacobians)
    };
    let (x, u) = (vec!["x".to_owned(), "theta".to_owned()], vec!["u".to_owned()]);
    let whole = (x.clone(), u.clone(), true);
    assert_eq!(read(quote!(coordinates = [x, theta: [2]] inputs = [u], jacobians)), whole);
    assert_eq!(read(quote!(coordinates [x, theta [2]], inputs = [u], jacobians)), whole);
    assert_eq!(read(quote!(= [x, mut theta: [2]], inputs = [u], jacobians)), whole);
    assert_eq!(read(quote!(coordinates = [x, theta: [2]], stray inputs = [u], jacobians)), whole);
    assert_eq!(read(quote!(coordinates = [x, theta: [2]], inputs =)), (x, Vec::new(), false));
}

#[test]
fn recovery_survives_anything() {
    for (args, item) in [
        (quote!(), quote!()),
        (quote!(= = ), quote!(impl)),
        (
            quote!(coordinates = [x]),
            quote!(
                struct S;
            ),
        ),
        (
            quote!(coordinates = [x]),
            quote!(
                #[potential]
                fn f() {}
            ),
        ),
        (quote!(coordinates = [x]), quote!(impl Drop for S { #[potential] fn drop(&mut self) {} })),
        (quote!(coordinates), quote!(impl [f64; 3] { fn f(&self) -> f64 { } })),
    ] {
        let recovered = flat(crate::expand(args, item, "::lagrangian"));
        assert!(!recovered.contains("[potential"), "{recovered}");
    }
}
