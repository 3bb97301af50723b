//! Integers among the fields: what is computed of them is evaluated as the description writes it.

use quote::quote;

use super::{lowered, refused};

/// The parameters of a potential with this body.
fn parameters(attribute: proc_macro2::TokenStream, body: proc_macro2::TokenStream) -> Vec<String> {
    let item = quote! {
        impl S {
            const N: usize = 3;
            #[potential]
            fn energy(&self, q: &Coordinates) -> f64 { #body }
            fn half(&self) -> i32 { -self.i / 2 }
            fn twice(n: i32) -> f64 { let m = n * 2; m as f64 }
        }
    };
    let model = lowered(attribute, item).unwrap_or_else(|messages| panic!("{body} {messages:?}"));
    model.parameters.into_iter().map(|parameter| parameter.path).collect()
}

#[test]
fn conversions_of_integers_are_those_of_rust() {
    for (body, expected) in [
        (quote!(((-self.i) as f64) * q.x), "((-self.i) as f64)"),
        (quote!((self.i as i64).abs() as f64 * q.x), "((self.i as i64).abs() as f64)"),
        (quote!(f64::from(-self.i) * q.x), "f64::from((-self.i))"),
        (quote!((self.n / 2) as f64 * q.x), "((self.n / 2) as f64)"),
        (quote!((2 - self.n % 3) as f64 * q.x), "((2 - (self.n % 3)) as f64)"),
        (quote!((self.i * self.pair.1[2] - 1) as f64 * q.x), "(((self.i * self.pair.1[2]) - 1) as f64)"),
        (quote!((Self::N - self.n) as f64 * q.x), "((3 - self.n) as f64)"),
        (quote!(self.n.pow(2) as f64 * q.x), "(self.n.pow(2) as f64)"),
        (quote!(self.i.max(-2) as f64 * q.x), "(self.i.max((-2)) as f64)"),
        (quote!(self.list.len() as f64 * q.x), "(self.list.len() as f64)"),
        (quote!((i64::from(self.i) - 4) as f64 * q.x), "((i64::from(self.i) - 4) as f64)"),
        (quote!((!self.is_off) as i32 as f64 * q.x), "(((!self.is_off) as i32) as f64)"),
        (
            quote!(f64::from((self.n as u32).min(crate::MOST)) * q.x),
            "f64::from((self.n as u32).min(crate::MOST))",
        ),
        // By variables and helpers.
        (quote!(let n = self.n / 2; let m = n + self.k; m as f64 * q.x), "(((self.n / 2) + self.k) as f64)"),
        (quote!(let n = (self.i as i64).abs(); -n as f64 * q.x), "((-(self.i as i64).abs()) as f64)"),
        (quote!(let n: i32 = -self.i; n as f64 * q.x), "((-self.i) as f64)"),
        (quote!(let i = self.i; f64::from(-i) * q.x), "f64::from((-self.i))"),
        (quote!(f64::from(self.half()) * q.x), "f64::from(((-self.i) / 2))"),
        (quote!(Self::twice(-self.i) * q.x), "(((-self.i) * 2) as f64)"),
        (quote!(let mut n = self.n; n += 1; n as f64 * q.x), "((self.n + 1) as f64)"),
    ] {
        assert_eq!(parameters(quote!(coordinates = [x]), body), [expected]);
    }
}

/// A description of any scalar converts twice.
#[test]
fn conversions_into_doubles_are_kept() {
    let item = quote! {
        impl<R: Real> S<R> {
            #[potential]
            fn energy(&self, q: &Coordinates<R>) -> R {
                (R::from_f64(f64::from(-self.i)) + R::from_f64((self.n / 2) as f64)) * q.x
            }
        }
    };
    let model = lowered(quote!(coordinates = [x]), item).unwrap_or_else(|messages| panic!("{messages:?}"));
    let paths: Vec<&str> = model.parameters.iter().map(|parameter| &*parameter.path).collect();
    let from = "<R as ::lagrange_runtime::Real>::from_f64";
    assert_eq!(paths, [format!("{from}(f64::from((-self.i)))"), format!("{from}(((self.n / 2) as f64))")]);
}

/// Numbers of the scalar type stay in sight: derivatives are taken by them.
#[test]
fn conversions_of_numbers_are_formulas() {
    let attribute = quote!(coordinates = [x], sensitivities = [self.a]);
    assert_eq!(parameters(attribute, quote!((self.a * self.b) as f64 * q.x)), ["self.a", "self.b"]);
    let body = quote!(let a = self.a; f64::from(-a * 2.0) * q.x + (self.b.sqrt() + 1.0) as f64 * q.x);
    assert_eq!(parameters(quote!(coordinates = [x]), body), ["self.a", "self.b"]);
}

#[test]
fn integers_are_no_numbers() {
    let body = |body: proc_macro2::TokenStream, message: &str| {
        let item = quote!(impl S { #[potential] fn energy(&self, q: &Coordinates) -> f64 { #body } });
        refused(quote!(coordinates = [x, a: [3]]), item, message);
    };
    let two = "this is an integer where a number of the scalar type is needed; write `2.0` or convert it";
    body(
        quote!(self.n / 2 * q.x),
        "this is an integer where a number of the scalar type is needed; write `2.0`, or convert the quotient of \
         integers, which drops the fraction: `(self.n / 2) as f64`",
    );
    body(quote!(2 * self.mass * q.x), two);
    body(quote!(let m = self.mass * 2; m * q.x), two);
    body(quote!((self.place * 2).x * q.x), two);
    body(quote!((self.i as i64).abs() * q.x), "`(self.i as i64).abs()` is an integer where a number of");
    body(quote!(let n: i32 = self.i; n * q.x), "`self.i` is an integer where a number of");
    body(quote!(q.a[self.n - 2]), "the value of `(self.n - 2)` is not known to the macro; use a literal");
    body(quote!(self.arr[self.n - 2] * q.x), "the value of `(self.n - 2)` is not known to the macro; use");
    let branch = "the branch depends on the whole number `(self.n / 2)`: the macro does not know its value";
    body(quote!(if self.n / 2 > 1 { q.x } else { 0.0 }), branch);
    body(quote!(if self.n / 2 > self.k { q.x } else { 0.0 }), branch);
    body(quote!(self.x % 3 * q.x), "`%` jumps, so it has no derivative; ");
}
