//! The guide: what the README leaves out. The same pages are in `src/doc` as Markdown.

/// Declares a page as a module. The definitions before its text let links between pages lead to these modules; the definitions at a page's
/// end, which lead to files, come second and are ignored by rustdoc.
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
