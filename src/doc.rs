//! The user guide: everything beyond the README. The same pages are in `src/doc` as Markdown.

/// Declares each page as a module. The link definitions before its text make links between pages lead to these modules; rustdoc ignores the
/// later definitions at a page's end, which lead to files.
macro_rules! pages {
    ($($name:ident $text:literal)*) => {
        $(
            #[doc = "[api]: crate::doc::api\n[figures]: crate::doc::figures\n[formats]: crate::doc::formats\n[guarantees]: crate::doc::guarantees"]
            #[doc = "[install]: crate::doc::install\n[method]: crate::doc::method\n[options]: crate::doc::options"]
            #[doc = "[rust]: crate::doc::rust\n[tetgen]: crate::doc::tetgen\n[vocabulary]: crate::doc::vocabulary\n[warnings]: crate::doc::warnings\n"]
            #[doc = include_str!($text)]
            pub mod $name {}
        )*
    };
}

pages! {
    api "doc/api.md"
    figures "doc/figures.md"
    formats "doc/formats.md"
    guarantees "doc/guarantees.md"
    install "doc/install.md"
    method "doc/method.md"
    options "doc/options.md"
    rust "doc/rust.md"
    tetgen "doc/tetgen.md"
    vocabulary "doc/vocabulary.md"
    warnings "doc/warnings.md"
}
