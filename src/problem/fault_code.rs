//! The reasons for which a problem file is refused, one by one.
//!
//! Every fault carries one, so that a test can tell which of them the files in `tests/bad` and
//! `tests/bad_geometry` have raised: a rule without a bad file fails it.

/// An enum and the list of all its variants, which so cannot disagree.
macro_rules! listed {
    (
        $(#[$about:meta])*
        pub enum $name:ident {
            $($(#[$meaning:meta])* $variant:ident,)*
        }
    ) => {
        $(#[$about])*
        #[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
        pub enum $name {
            $($(#[$meaning])* $variant,)*
        }

        impl $name {
            /// Every one of them.
            pub const ALL: &'static [Self] = &[$(Self::$variant,)*];
        }
    };
}

pub(super) use listed;

listed! {
    /// Why something in a problem file is refused. Places that refuse for the same reason share a
    /// rule.
    pub enum FaultCode {
        // The file as a whole.
        /// The operating system does not hand the file over.
        FileUnreadable,
        /// More bytes than any problem file needs.
        FileTooLarge,
        /// A key whose value cannot be changed where it stands.
        NotChangeable,
        /// Nothing but comments.
        FileEmpty,
        /// Bytes that are not UTF-8.
        NotUtf8,
        /// A second YAML document.
        SecondDocument,
        /// Not YAML.
        NotYaml,
        /// A tab in an indentation.
        Tab,
        /// A key that is a list, a group, or nothing.
        KeyNotAName,
        /// Groups within groups beyond any need.
        NestedTooDeeply,
        /// Values or aliases beyond any need.
        TooManyValues,
        /// A list or a group longer than any need.
        TooManyItems,
        /// A key longer than any need.
        KeyTooLong,
        /// A text longer than any need.
        TextTooLong,
        /// An alias within what it repeats.
        AliasOfItself,
        /// An alias of a value that does not stand before it.
        UnknownAlias,
        /// A merge key.
        MergeKey,
        /// A tag of another language than this one.
        UnknownTag,

        // Keys and the kinds of their values.
        /// A key that its group does not have.
        UnknownKey,
        /// A key that another group has.
        MisplacedKey,
        /// The digits behind a decimal comma.
        DecimalComma,
        /// A key that its group holds already.
        RepeatedKey,
        /// A key, or an item of a list, that must be there.
        Missing,
        /// Text instead of a list, a group instead of a number, and the like.
        WrongKind,
        /// A list with more or fewer items than it must have.
        WrongLength,
        /// A list or a group without anything in it.
        NothingListed,
        /// A text without any letter.
        EmptyText,
        /// None of the words that may stand here.
        UnknownWord,
        /// The same name twice in a list.
        NamedTwice,
        /// What cannot be used as a name.
        UnusableName,
        /// A key that has no effect beside the others.
        NoEffect,
        /// Two keys of which only one may be there.
        EitherOr,
        /// None of the keys of which one must be there.
        NoneOfSeveral,

        // Numbers and quantities.
        /// A number that is not in plain decimal notation.
        NotAPlainNumber,
        /// Something else than a whole number from 0.
        NotAWholeNumber,
        /// Something else than a number with a unit.
        NotAQuantity,
        /// A quantity without its unit.
        NoUnit,
        /// A unit that is not known for this quantity.
        UnknownUnit,
        /// A quantity of another dimension.
        WrongDimension,
        /// More than a floating-point number can hold.
        Overflow,
        /// 0 or less where only more will do.
        NotPositive,
        /// Less than 0 where 0 is the least.
        Negative,
        /// Below its limit.
        TooSmall,
        /// Above its limit.
        TooLarge,
        /// A range whose first value is the larger one.
        UpsideDown,
        /// Azimuths that overlap themselves.
        MoreThanATurn,
        /// A direction without a length.
        NotADirection,

        // What the keys mean together.
        /// A version of the format that is not read.
        UnknownFormat,
        /// A name that the library does not have.
        NotInLibrary,
        /// A contact that the file does not have.
        UnknownContact,
        /// Dynamic friction above static friction.
        DynamicAboveStatic,
        /// Dynamic friction that is held while static friction is searched.
        HeldWhileSearched,
        /// A range in the contact of a single surface.
        SearchedOnASurface,
        /// A calibration that does not rise.
        NotRising,
        /// A tolerance wider than what is searched.
        ToleranceTooWide,
        /// A tolerance that lets a setting fall to 0.
        ToleranceReachesZero,
        /// The target on a part that the nozzle carries.
        TargetOnNozzle,
        /// The target as a deflector.
        TargetDeflects,

        // Parts and surfaces.
        /// A surface without the part before its name, or the other way round.
        NotASurface,
        /// A surface of a part that the file does not have.
        UnknownPart,
        /// A surface that its part does not have.
        UnknownSurface,
        /// A box that is flat or inside out.
        FlatBox,
        /// A groove as wide as its bore.
        GrooveTooWide,
        /// A root radius that does not fit into its groove.
        RootTooLarge,
        /// A surface called like a closed end.
        NameOfAnEnd,
        /// A line or an arc of no length.
        NoExtent,
        /// An arc through three points on a line.
        StraightArc,
        /// An outline that crosses itself.
        CrossingOutline,
        /// A cap on an outline that is not closed.
        OpenOutline,
        /// A part that is cut out of itself.
        CutsItself,
        /// A part that is cut out of another one, and is cut itself.
        CutOfACut,
        /// A part on the nozzle that is cut out of one that is not, or the other way round.
        CutAcrossFrames,
        /// What is cut, or cut out, encloses no volume.
        CutWithoutVolume,
        /// A part that does not reach the one that it is cut out of.
        CutMisses,
        /// A part of which cutting leaves nothing.
        CutLeavesNothing,
        /// A path of a mesh file that other systems read differently.
        PathNotPortable,
        /// A path out of the folder of the problem file.
        PathLeavesFolder,
        /// No piece of the target in its box.
        TargetEmpty,
        /// A target whose free side its mesh does not tell.
        FreeSideUnclear,
        /// An aim point beside the target.
        AimOffTarget,
        /// A target whose own centre is beside it.
        CentreOffTarget,
        /// A stroke that is not on the target.
        StrokeOffTarget,
        /// Azimuth 0 along the normal of the target.
        AlongPerpendicular,

        /// Too many triangles of all parts together.
        SceneTooLarge,

        // Mesh files, see `scene::mesh_file::Defect`.
        /// No such mesh file.
        MeshMissing,
        /// The operating system does not hand the mesh file over.
        MeshUnreadable,
        /// The name of another format.
        MeshFormatUnknown,
        /// Too many bytes.
        MeshTooLarge,
        /// Too many triangles.
        MeshTooManyTriangles,
        /// A face with too many corners.
        MeshTooManyCorners,
        /// Faces too winding to be cut into triangles.
        MeshFacesTooWinding,
        /// Too many groups.
        MeshTooManySurfaces,
        /// A name of a group that is too long.
        MeshNameTooLong,
        /// A line too long for a text.
        MeshLineTooLong,
        /// No byte in the mesh file.
        MeshEmpty,
        /// No triangle in the mesh file.
        MeshNoTriangles,
        /// Only triangles without area.
        MeshNoArea,
        /// A coordinate that is no finite number.
        MeshNotFinite,
        /// A coordinate beyond any part.
        MeshTooFarOut,
        /// A face with a corner that does not exist.
        MeshNoSuchVertex,
        /// Another number of triangles than promised.
        MeshWrongCount,
        /// Bytes of a program's own between the triangles.
        MeshVendorData,
        /// A file of another kind under the name of a mesh.
        MeshForeign,
        /// Something else than the format wants.
        MeshUnexpected,
        /// A mesh file cut short.
        MeshEndsEarly,
        /// A header without what a mesh needs.
        MeshNotInHeader,
        /// A region without a triangle.
        RegionEmpty,
        /// A region of a mesh at a point between two faces.
        RegionOnEdge,
        /// A region whose triangles all belong to later ones.
        RegionCovered,
    }
}
